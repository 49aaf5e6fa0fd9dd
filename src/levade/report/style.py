"""The look of pages, figures and videos: one palette (Okabe and Ito, safe for colour-blind readers), one font.

    theme = LIGHT                                   # or DARK
    theme.goal, theme.limit                         # "#rrggbb"
    leg_colours(motion.legs, theme)         # {"lf": "#0072b2", ...}

Each hue has one meaning. Front legs are blue, hind legs orange; left is darker than right, so the four also differ in grey. x
and roll are vermilion, y and pitch green, z and yaw blue. A reference is dashed, a measurement solid. A goal is a thin dashed
line in the colour of its quantity, a limit a shaded band.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass

from levade.robots import Leg

SANS = ("Inter", "Segoe UI", "Roboto", "Helvetica Neue", "Arial", "DejaVu Sans", "sans-serif")
"""Font families in order of preference; all have tabular figures or are drawn with them."""

MONO = ("ui-monospace", "SFMono-Regular", "Menlo", "Consolas", "DejaVu Sans Mono", "monospace")

DASHES = {"measured": (), "reference": (5, 3), "goal": (2, 3), "horizon": (1, 2)}
"""Meaning of a line -> its dashes in points; empty for solid."""


@dataclass(frozen=True)
class Theme:
    """Colours, each "#rrggbb".

    Attributes:
        page: Background of the page.
        panel: Background of a plot.
        ink: Text and axes.
        muted: Secondary text.
        grid: Grid lines.
        accent: Controls and the time cursor.
        good: Success, always next to a word.
        bad: Failure, always next to a word.
        measured: Lines of measured values that belong to no leg.
        reference: Lines of references that belong to no leg.
        goal: Lines of goals that belong to no quantity.
        limit: Limits, and the shade beyond them.
        best: Lines of the best cost.
        x: x and roll.
        y: y and pitch.
        z: z and yaw.
        front_left: The left front leg.
        front_right: The right front leg.
        hind_left: The left hind leg.
        hind_right: The right hind leg.
        others: Further legs, and other series.
        sky: Sky of the 3D scene.
        ground: Ground of the 3D scene.
        ground_line: Lines on the ground of the 3D scene.
        ghost: The ghost in the 3D scene.
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
        """Colours of x, y, z, which are also those of roll, pitch, yaw."""
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
    """Map each leg's name to its colour "#rrggbb".

    Args:
        legs: Legs of the robot.
        theme: Colours of the light or the dark page.

    Returns:
        Name of the leg -> colour.
    """
    places = leg_places(legs)
    return {
        name: theme.others[int(place[5:])] if place.startswith("other") else getattr(theme, place.replace("-", "_"))
        for name, place in places.items()
    }


def leg_places(legs: Iterable[Leg]) -> dict[str, str]:
    """Map each leg's name to the name of its colour in the stylesheet: "front-left" and so on, or "other0".

    Args:
        legs: Legs of the robot.

    Returns:
        Name of the leg -> name of the colour. The first leg at each corner gets the corner's colour.
    """
    free = {f"{end}-{side}" for end in ("front", "hind") for side in ("left", "right")}
    places = {}
    for number, leg in enumerate(legs):
        place = f"{leg.end}-{leg.side}"
        places[leg.name] = place if place in free else f"other{number % len(LIGHT.others)}"
        free.discard(place)
    return places


def stylesheet() -> str:
    """Return the palette as CSS variables, ``--ink`` and so on.

    It is light, or dark if the reader's system or the page asks for it.
    """

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
