"""The border's libraries are paid for by those who read files."""

import subprocess
import sys


def test_pydantic_and_yaml_are_imported_when_a_file_is_read() -> None:
    code = (
        "import sys, rightofway.io;"
        "print([name for name in ('pydantic', 'yaml', 'openpyxl', 'PIL') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"
