"""Scenario documents: their shape, read and written."""
