"""The look, once for page, figures and video: one palette (Okabe and Ito, safe for colour-blind readers), one font.

    theme = LIGHT                                   # or DARK
    theme.goal, theme.limit                         # "#rrggbb"
    leg_colours(motion.legs, theme)         # {"lf": "#0072b2", ...}

Hues keep one meaning: front legs are blue, hind legs orange; left is darker than right, so the four also differ in grey.
x and roll are vermilion, y and pitch green, z and yaw blue. A reference is dashed, a measurement solid, a goal a thin
dashed line in the colour of its quantity, a limit a shaded band.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass

from levade.robots import Leg

SANS = ("Inter", "Segoe UI", "Roboto", "Helvetica Neue", "Arial", "DejaVu Sans", "sans-serif")
"""Font families in order of preference; all have tabular figures or are drawn with them."""

MONO = ("ui-monospace", "SFMono-Regular", "Menlo", "Consolas", "DejaVu Sans Mono", "monospace")

DASHES = {"measured": (), "reference": (5, 3), "goal": (2, 3), "horizon": (1, 2)}
"""What a line means -> its dashes, in points; empty for solid."""


@dataclass(frozen=True)
class Theme:
    """Colours, each "#rrggbb".

    Attributes:
        page: Behind everything, behind a plot.
        panel: Behind everything, behind a plot.
        ink: Text and axes, secondary text, grid lines.
        muted: Text and axes, secondary text, grid lines.
        grid: Text and axes, secondary text, grid lines.
        accent: Controls and the time cursor.
        good: Success and failure (always next to a word).
        bad: Success and failure (always next to a word).
        measured: Lines that belong to no leg. limit is also the shade beyond a limit.
        reference: Lines that belong to no leg. limit is also the shade beyond a limit.
        goal: Lines that belong to no leg. limit is also the shade beyond a limit.
        limit: Lines that belong to no leg. limit is also the shade beyond a limit.
        best: Lines that belong to no leg. limit is also the shade beyond a limit.
        x: Also roll, pitch, yaw. front_left ...
        y: Also roll, pitch, yaw. front_left ...
        z: Also roll, pitch, yaw. front_left ...
        hind_right: Legs.
        others: Legs beyond those, and anything counted.
        sky: The 3D scene.
        ground: The 3D scene.
        ground_line: The 3D scene.
        ghost: The 3D scene.
    """

    page: str
    panel: str
    ink: str
    muted: str
    grid: str
    accent: str
    good: str
    bad: str
    measured: str
    reference: str
    goal: str
    limit: str
    best: str
    x: str
    y: str
    z: str
    front_left: str
    front_right: str
    hind_left: str
    hind_right: str
    others: tuple[str, ...]
    sky: str
    ground: str
    ground_line: str
    ghost: str

    @property
    def axes(self) -> tuple[str, str, str]:
        """x, y, z, or roll, pitch, yaw."""
        return self.x, self.y, self.z


LIGHT = Theme(
    page="#f6f6f4",
    panel="#ffffff",
    ink="#1d2126",
    muted="#5f6770",
    grid="#e4e5e3",
    accent="#0b6aa8",
    good="#00795a",
    bad="#b3410a",
    measured="#1d2126",
    reference="#7a828b",
    goal="#00795a",
    limit="#b65a8c",
    best="#0072b2",
    x="#d55e00",
    y="#008c66",
    z="#0072b2",
    front_left="#005a94",
    front_right="#4aaee6",
    hind_left="#c24d00",
    hind_right="#e69f00",
    others=("#008c66", "#b65a8c", "#7a828b", "#1d2126"),
    sky="#eef1f4",
    ground="#e3e6e9",
    ground_line="#c6cbd1",
    ghost="#009e73",
)

DARK = Theme(
    page="#14171a",
    panel="#1c2024",
    ink="#e8eaec",
    muted="#9aa3ac",
    grid="#30363c",
    accent="#5fb4ea",
    good="#3fc79d",
    bad="#f2884b",
    measured="#e8eaec",
    reference="#8f98a2",
    goal="#3fc79d",
    limit="#d58ab4",
    best="#5fb4ea",
    x="#f07f35",
    y="#2fbd92",
    z="#5fb4ea",
    front_left="#3f95dc",
    front_right="#a3dbfa",
    hind_left="#e2672a",
    hind_right="#f6c453",
    others=("#2fbd92", "#d58ab4", "#8f98a2", "#e8eaec"),
    sky="#191d21",
    ground="#23282d",
    ground_line="#3a4249",
    ghost="#3fc79d",
)


def leg_colours(legs: Iterable[Leg], theme: Theme) -> dict[str, str]:
    """Colour of each leg: leg name -> "#rrggbb"."""
    places = leg_places(legs)
    return {
        name: theme.others[int(place[5:])] if place.startswith("other") else getattr(theme, place.replace("-", "_"))
        for name, place in places.items()
    }


def leg_places(legs: Iterable[Leg]) -> dict[str, str]:
    """What each leg's colour is called in the stylesheet: leg name -> "front-left" and so on, or "other0"."""
    free = {f"{end}-{side}" for end in ("front", "hind") for side in ("left", "right")}
    places = {}
    for number, leg in enumerate(legs):
        place = f"{leg.end}-{leg.side}"
        places[leg.name] = place if place in free else f"other{number % len(LIGHT.others)}"
        free.discard(place)
    return places


def stylesheet() -> str:
    """The palette as CSS variables, ``--ink`` and so on: light, and dark where the reader's system or the page asks."""

    def variables(theme: Theme) -> str:
        colours = {name: value for name, value in asdict(theme).items() if isinstance(value, str)}
        colours |= {f"other{number}": value for number, value in enumerate(theme.others)}
        return "".join(f"--{name.replace('_', '-')}:{value};" for name, value in colours.items())

    light, dark = variables(LIGHT), variables(DARK)
    return (
        f":root{{color-scheme:light;{light}}}"
        f"@media(prefers-color-scheme:dark){{:root:not([data-theme=light]){{color-scheme:dark;{dark}}}}}"
        f":root[data-theme=dark]{{color-scheme:dark;{dark}}}"
    )
