"""What people and programs read about plans, laps and executions: sentences, reports, data."""
