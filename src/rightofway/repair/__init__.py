"""The machinery of planners: tasks, proofs that no plan exists, conflicts, rights of way reversed.

Nothing here is a planner: `planners` chooses and combines these parts.
"""
