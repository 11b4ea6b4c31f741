"""Text to plain data and back: files, YAML, JSON, exact numbers."""
