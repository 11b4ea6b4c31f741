"""Slow, obvious twins of the native kernels: what the kernels must agree with."""
