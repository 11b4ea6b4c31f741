"""The floor, where robots are late: delays, and what becomes of a plan under them."""
