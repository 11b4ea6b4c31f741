"""Scripts of others in the studio: ``python -m tests.builders.vendored`` copies them from npm.

``vendor.json`` beside them names package, version, the path in it, and the hash. npm fetches the
packages, which ``package.json`` pins; nothing is changed on the way.
"""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
VENDOR = ROOT / "src" / "rightofway" / "studio" / "assets" / "vendor"
PACKAGES = ROOT / "node_modules"


def record() -> dict[str, dict[str, Any]]:
    """Return what ``vendor.json`` says of each file."""
    found: dict[str, dict[str, Any]] = json.loads((VENDOR / "vendor.json").read_text("utf-8"))
    return found


def published(entry: dict[str, Any]) -> bytes:
    """Return a file as its package has it, of the version that is recorded."""
    package = PACKAGES / str(entry["package"])
    version = json.loads((package / "package.json").read_text("utf-8"))["version"]
    assert version == entry["version"], f"{entry['package']} is {version} (run `npm ci`)"
    return (package / str(entry["path"])).read_bytes()


def digest(content: bytes) -> str:
    """Return the hash of a file as the record has it."""
    return sha256(content).hexdigest()


if __name__ == "__main__":
    known = record()
    for name, entry in known.items():
        content = published(entry)
        (VENDOR / name).write_bytes(content)
        entry["sha256"] = digest(content)
    (VENDOR / "vendor.json").write_text(json.dumps(known, indent=2) + "\n", "utf-8")
