"""Plan documents: their shape, read and written."""
