"""Files of jobs, and orders of other programs that are read as jobs."""
