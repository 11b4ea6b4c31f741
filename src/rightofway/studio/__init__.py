"""The studio: a server for one folder, whose pages draw, plan, watch and compare.

FastAPI and uvicorn (the extra ``studio``) are imported by `app` and `serve` alone. The server moves
text between browsers, a store and workers; workers read, validate, plan and draw.
"""
