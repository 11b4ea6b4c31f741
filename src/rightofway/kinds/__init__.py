"""Kinds of values: their names, readers, JSON Schemas and remedies."""

from rightofway.kinds.table import Kind, make_number, make_whole, make_words

__all__ = ["Kind", "make_number", "make_whole", "make_words"]
