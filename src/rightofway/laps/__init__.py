"""Work that repeats: rules on endless routes, recurrence, and timetables chosen to repeat well."""
