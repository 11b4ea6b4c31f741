"""The remaining work of a fleet: plans that begin where robots are, or with another plan."""
