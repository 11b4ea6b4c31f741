"""The models of pydantic for documents: every fault of data, and JSON Schemas."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, get_args, get_type_hints

from pydantic import BaseModel, ConfigDict, Field, TypeAdapter, create_model
from pydantic_core import core_schema as core

from rightofway.io.fields import REQUIRED, Document

if TYPE_CHECKING:
    from rightofway.io.fields import DocumentField
    from rightofway.kinds.table import Schema


@cache
def make_adapter(document: type[Document | BaseModel]) -> TypeAdapter[Any]:
    """Return the reader of a document or a model that names every fault."""
    return TypeAdapter(document)


def find_model(annotation: Any) -> type[BaseModel] | None:
    """Return the model of the first document or model in a type; None if it contains none."""
    if isinstance(annotation, type) and issubclass(annotation, Document):
        return make_model(annotation)  # type: ignore[arg-type]
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    inside = (find_model(argument) for argument in get_args(annotation))
    return next((inner for inner in inside if inner), None)


@cache
def make_model(document: type[Document]) -> type[BaseModel]:
    """Return the model of a document, with the same fields."""
    hints = get_type_hints(document, include_extras=True)
    fields: dict[str, Any] = {
        name: (hints[name], _make_field(field)) for name, field in document.fields.items()
    }
    return create_model(
        document.__name__,
        __base__=_make_base(document),
        __module__=document.__module__,
        __doc__=document.__doc__,
        **fields,
    )


def make_core_schema(document: type[Document], handler: Any) -> core.CoreSchema:
    """Return the schema that reads data by the model of a document, and returns the document."""

    def build(model: BaseModel) -> Document:
        given = model.model_fields_set
        return document({name: getattr(model, name) for name in document.fields if name in given})

    model = make_model(document)  # type: ignore[arg-type]
    schema = core.no_info_after_validator_function(build, handler.generate_schema(model))
    read_short = getattr(document, "read_short", None)
    return core.no_info_before_validator_function(read_short, schema) if read_short else schema


def _make_field(field: DocumentField) -> Any:
    default: Any = ... if field.default is REQUIRED else field.default
    limits: dict[str, Any] = dict(field.limits)
    return Field(default, alias=field.alias, description=field.description, **limits)


def _make_base(document: type[Document]) -> type[BaseModel]:
    """Return the base of the model of a document, with its rules and its JSON Schema."""
    extend_schema = getattr(document, "extend_schema", None)

    def finish(schema: Schema) -> None:
        for field in schema.get("properties", {}).values():
            if field.get("default", "") is None:  # a written null is refused
                del field["default"]
        schema.update(document.schema_extra)

    class Base(BaseModel):
        model_config = ConfigDict(
            extra="forbid",
            strict=True,
            arbitrary_types_allowed=True,
            json_schema_extra=finish,
        )

        @classmethod
        def __get_pydantic_json_schema__(cls, schema: Any, handler: Any) -> Schema:
            plain: Schema = handler(schema)
            return extend_schema(handler.resolve_ref_schema(plain)) if extend_schema else plain

    return Base
