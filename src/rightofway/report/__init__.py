"""What people and programs read about plans, laps and executions: sentences, reports, data.

Its modules are imported one by one: a report on laps needs `cyclic`, one on a plan does not.
"""

__all__: list[str] = []
