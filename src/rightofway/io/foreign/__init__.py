"""Plans that other programs write and read: one module a format, recognised by content.

==========  ========================================================================
name        programs
==========  ========================================================================
lacam       lacam, lacam3, pypibt, mapf-visualizer: one line for each step
lns2        MAPF-LNS2, EECBS, CBSH2: one line for each agent
planviz     PlanViz and the League of Robot Runners, rounds 2023, 2024 and 2026
schedule    multi_agent_path_planning (atb033), libMultiRobotPlanning: a YAML schedule
==========  ========================================================================
"""

from rightofway.io.foreign.formats import (
    FOREIGN_FORMATS,
    format_foreign,
    format_of_text,
    is_foreign,
    read_foreign,
)

__all__ = ["FOREIGN_FORMATS", "format_foreign", "format_of_text", "is_foreign", "read_foreign"]
