"""A plan as a picture (PNG) or a short film (GIF), in the colours of the page."""
