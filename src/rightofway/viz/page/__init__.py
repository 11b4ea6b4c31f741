"""A plan as one HTML file that plays it: no network, no server, nothing to install."""
