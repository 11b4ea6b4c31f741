"""Reports on plans, laps and executions for people and programs: sentences, tables, data.

Its modules are imported one by one: a report on laps needs `cyclic`, one on a plan does not.
"""

__all__: list[str] = []
