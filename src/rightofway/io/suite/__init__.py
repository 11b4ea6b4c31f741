"""Suite documents: what the benchmark is to run."""
