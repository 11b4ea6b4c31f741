"""Long campaigns of checks, each a recipe that anyone can run; none is a test of pytest."""
