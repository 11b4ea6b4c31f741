"""The place that robots drive in: roadmap, zones, walls, lanes and their pieces, places by name."""

from rightofway.site.clustering import Floor, Obstacle, cluster, node_length, steps_per_unit
from rightofway.site.edges import Edge, roadmap_of_edges
from rightofway.site.geometry import (
    Frame,
    Point,
    VertexId,
    rounding_step,
    squared_distance,
    straight_length,
)
from rightofway.site.grid import roadmap_of_grid
from rightofway.site.roadmap import EdgeClass, Grid, Lane, Roadmap

__all__ = [
    "Edge",
    "EdgeClass",
    "Floor",
    "Frame",
    "Grid",
    "Lane",
    "Obstacle",
    "Point",
    "Roadmap",
    "VertexId",
    "cluster",
    "node_length",
    "roadmap_of_edges",
    "roadmap_of_grid",
    "rounding_step",
    "squared_distance",
    "steps_per_unit",
    "straight_length",
]
