"""Draw a motion's figures for a paper: one file each, at column width, also legible in grey.

    figures(motion, "figures", format="pdf", progress_csv="rearing/progress.csv")
    compare({"seed 0": first, "seed 1": second}, "figures")

trunk        position and orientation of the trunk over time, with the goals (the paper's Fig. 3a and 6a)
cost         best cost, and the spread of each generation, over the trials (Fig. 3b and 6b); needs progress.csv
joints       reference and measured angle of each joint, with its range (Fig. 4 and 7)
torques      torque of each joint, with its limit
speeds       speed of each joint, with its limit
foot-forces  contact force on each foot
kernels      the normalised kernels, and each policy with its weights (Fig. 1)

The figures need matplotlib (`pip install 'levade[figures]'`). The same motion gives the same bytes.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from levade.arrays import Array
from levade.errors import LevadeError, did_you_mean
from levade.motions import Motion
from levade.motions.file import finite
from levade.report.files import writing
from levade.report.series import (
    QUANTITIES,
    Progress,
    goals,
    kernels_of,
    policy_names,
    read_progress,
    short,
    trunk_values,
    weights_of,
)
from levade.report.style import LIGHT, leg_colours

FORMATS = ("pdf", "svg", "png")

COLUMN, PAGE = 3.5, 7.16
"""Width of one column and of two [in], as IEEE has them."""

_STYLES: tuple[Any, ...] = ("-", (0, (4, 1.6)), (0, (5, 1.5, 1, 1.5)), (0, (1.2, 1.2)))
"""Line styles that differ in grey print: solid, dashed, dash-dotted, dotted."""

_RC: dict[str, Any] = {
    "font.family": ["DejaVu Sans"],  # comes with matplotlib: the same everywhere
    "font.size": 7.5,
    "axes.labelsize": 7.5,
    "axes.titlesize": 7.5,
    "axes.titlelocation": "left",
    "axes.titlepad": 4.0,
    "axes.linewidth": 0.6,
    "axes.edgecolor": LIGHT.muted,
    "axes.labelcolor": LIGHT.ink,
    "axes.titlecolor": LIGHT.ink,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.formatter.use_mathtext": True,
    "grid.color": LIGHT.grid,
    "grid.linewidth": 0.5,
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "xtick.color": LIGHT.muted,
    "ytick.color": LIGHT.muted,
    "xtick.labelcolor": LIGHT.ink,
    "ytick.labelcolor": LIGHT.ink,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.major.size": 2.5,
    "ytick.major.size": 2.5,
    "text.color": LIGHT.ink,
    "lines.linewidth": 1.2,
    "legend.frameon": False,
    "legend.fontsize": 7,
    "legend.handlelength": 2.4,
    "legend.columnspacing": 1.4,
    "legend.borderaxespad": 0.2,
    "legend.borderpad": 0.1,
    "savefig.dpi": 300,
    "pdf.fonttype": 42,  # TrueType: journals refuse Type 3
    "svg.hashsalt": "levade",
}


def figures(
    motion: Motion, directory: str | Path, *, format: str = "pdf", progress_csv: str | Path | None = None
) -> list[Path]:
    """Write all figures of a motion to a directory.

    Args:
        motion: A motion.
        directory: Directory to write. It is created if it does not exist.
        format: "pdf", "svg" or "png".
        progress_csv: The progress.csv of the search. Without it there is no figure of the cost.

    Returns:
        The files that were written.

    Raises:
        LevadeError: If the format is unknown, the directory cannot be written, or matplotlib is missing.
    """
    drawings: dict[str, Callable[[], Any]] = {
        "trunk": lambda: _trunk({"": motion}),
        "joints": lambda: _joints(motion),
        "torques": lambda: _limited(motion, "joint_torque", "torque", "Nm"),
        "speeds": lambda: _limited(motion, "joint_velocity", "speed", "rad/s"),
        "foot-forces": lambda: _foot_forces(motion),
        "kernels": lambda: _kernels(motion),
    }
    if progress_csv is not None:
        progress = read_progress(progress_csv)
        first = motion.result.trials_to_success
        drawings["cost"] = lambda: _cost(progress, first)
    return write_figures(drawings, Path(directory), format)


def compare(
    motions: Mapping[str, Motion],
    directory: str | Path,
    *,
    format: str = "pdf",
    progress_csv: Mapping[str, str | Path] | None = None,
) -> list[Path]:
    """Write figures that compare motions: their trunks, and the costs of their searches.

    Args:
        motions: Name in the legend -> motion.
        directory: Directory to write. It is created if it does not exist.
        format: "pdf", "svg" or "png".
        progress_csv: Name -> progress.csv of the search. The figure of the cost leaves out motions without one.

    Returns:
        The files that were written.
    """
    drawings: dict[str, Callable[[], Any]] = {"trunk": lambda: _trunks(motions)}
    if progress_csv:
        progress = {name: read_progress(path) for name, path in progress_csv.items()}
        drawings["cost"] = lambda: _costs(progress)
    return write_figures(drawings, Path(directory), format)


def write_figures(drawings: Mapping[str, Callable[[], Any]], directory: Path, format: str) -> list[Path]:
    """Draw figures by name, in the common style, into files in a directory: see `figures`.

    Args:
        drawings: Name -> function that draws a matplotlib figure.
        directory: Directory to write.
        format: "pdf", "svg" or "png".

    Returns:
        Paths of the files, one per figure.

    Raises:
        LevadeError: If the format is unknown, the directory cannot be written, or matplotlib is missing.
    """
    if format not in FORMATS:
        raise LevadeError(f"format {format}: unknown; {did_you_mean(format, FORMATS)}")
    try:
        import matplotlib
        from matplotlib.backends.backend_agg import FigureCanvasAgg
    except ImportError:
        raise LevadeError("figures need matplotlib; pip install 'levade[figures]'") from None
    # whatever would tell one run from another is left out
    metadata = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}[format]
    written = []
    settings: Any = {**matplotlib.rcParamsDefault, **_RC}
    with matplotlib.rc_context(settings):
        for name, draw in drawings.items():
            path = directory / f"{name}.{format}"
            with writing(path) as partial:
                figure = draw()
                FigureCanvasAgg(figure)
                figure.savefig(partial, format=format, metadata=metadata)
            written.append(path)
    return written


def _figure(width: float, height: float, rows: int = 1, columns: int = 1, **options: Any) -> tuple[Any, Any]:
    """Make a figure, and its axes (rows, columns)."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width, height), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.03, h_pad=0.03, wspace=0.02, hspace=0.03)  # type: ignore[union-attr]
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def _key(figure: Any, handles: Sequence[Any], columns: int) -> None:
    figure.legend(handles=handles, loc="outside upper center", ncols=columns)


def _line(label: str, **look: Any) -> Any:
    from matplotlib.lines import Line2D

    return Line2D([], [], label=label, **look)


def _time_axis(axes: Any, motion: Motion, *, label: bool = True) -> None:
    """Make time the x axis. The hold is shaded, and a long hold has a shorter scale."""
    horizon, end = motion.horizon, motion.duration
    axes.set_xlim(0.0, end)
    held = end - horizon > 1e-9
    if _squeezed(motion):  # the hold takes a quarter of the width
        rate = (end - horizon) * 3.0 / horizon

        def forward(t: Array) -> Array:
            return np.where(t <= horizon, t, horizon + (t - horizon) / rate)

        def inverse(s: Array) -> Array:
            return np.where(s <= horizon, s, horizon + (s - horizon) * rate)

        axes.set_xscale("function", functions=(forward, inverse))
        axes.set_xlim(0.0, end)
        step = _step(horizon, 4)
        ticks = [k * step for k in range(round(horizon / step + 0.5)) if k * step < horizon * 0.95]
        axes.set_xticks([*ticks, horizon, end], [f"{tick:g}" for tick in [*ticks, horizon, end]])
    if held:
        axes.axvspan(horizon, end, color=LIGHT.page, linewidth=0, zorder=0)
        axes.axvline(horizon, color=LIGHT.muted, linewidth=0.6, dashes=(1, 2), zorder=1)
    if label:
        axes.set_xlabel(_time_label(motion))


def _squeezed(motion: Motion) -> bool:
    return motion.duration > 1.5 * motion.horizon


def _time_label(motion: Motion) -> str:
    return "time [s]" + (" (hold drawn shorter)" if _squeezed(motion) else "")


def _step(span: float, parts: int) -> float:
    """Return a round number near span / parts."""
    raw = span / parts
    power = 10.0 ** math.floor(math.log10(raw))
    return min((factor * power for factor in (1, 2, 5, 10)), key=lambda step: abs(math.log(step / raw)))


_NAMES = ({"x": "$x$", "y": "$y$", "height": "$z$"}, {"roll": "roll", "pitch": "pitch", "yaw": "yaw"})


def _trunk(motions: Mapping[str, Motion]) -> Any:
    ((_, motion),) = motions.items()
    figure, grid = _figure(COLUMN, 3.7, 2, 1, sharex=True)
    targets = goals(motion)
    for row, (values, unit) in enumerate(zip(trunk_values(motion), ("position [m]", "orientation [rad]"), strict=True)):
        axes = grid[row, 0]
        _time_axis(axes, motion, label=row == 1)
        wanted: list[float] = []
        for k, (quantity, name) in enumerate(_NAMES[row].items()):
            colour, style = LIGHT.axes[k], _STYLES[k]
            axes.plot(motion["time"], values[:, k], color=colour, linestyle=style, label=name)
            for when, target, tolerance in targets.get(quantity, []):
                wanted += [target - tolerance, target + tolerance]
                axes.plot([0.0, when], [target] * 2, color=colour, linewidth=0.7, dashes=(2, 3), zorder=1.5)
                axes.errorbar(
                    *(when, target, tolerance),
                    fmt="o",
                    color=colour,
                    markersize=4,
                    markerfacecolor="white",
                    markeredgewidth=1.0,
                    elinewidth=1.0,
                    capsize=2.5,
                    capthick=1.0,
                    zorder=3,
                    clip_on=False,
                )
        _at_least(axes, 0.02, wanted)
        handles = [
            _line(name, color=LIGHT.axes[k], linestyle=_STYLES[k]) for k, name in enumerate(_NAMES[row].values())
        ]
        if any(quantity in targets for quantity in QUANTITIES[row]):
            handles.append(
                _line(
                    "goal",
                    color=LIGHT.ink,
                    linewidth=0.7,
                    dashes=(2, 3),
                    marker="o",
                    markersize=4,
                    markerfacecolor="white",
                )
            )
        axes.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=4)
        axes.set_ylabel("trunk " + unit)
    figure.align_ylabels()
    return figure


def _at_least(axes: Any, span: float, wanted: Sequence[float] = ()) -> None:
    """Choose limits of y that show all lines and all required values, without magnifying noise."""
    lines = [np.asarray(line.get_ydata(), dtype=float) for line in axes.get_lines() if len(line.get_ydata()) > 2]
    values = np.concatenate([*lines, np.asarray(wanted, dtype=float)])
    values = values[np.isfinite(values)]
    low, high = (float(values.min()), float(values.max())) if len(values) else (0.0, 1.0)
    room = max(0.0, span - (high - low)) / 2 + 0.06 * max(high - low, span)
    axes.set_ylim(low - room, high + room)


def _motion_looks(n: int) -> list[dict[str, Any]]:
    colours = (LIGHT.z, LIGHT.x, LIGHT.y, *LIGHT.others[1:])
    return [{"color": colours[k % len(colours)], "linestyle": _STYLES[k % len(_STYLES)]} for k in range(n)]


def _trunks(motions: Mapping[str, Motion]) -> Any:
    figure, grid = _figure(PAGE, 3.8, 2, 3, sharex=True)
    longest = max(motions.values(), key=lambda motion: float(motion["time"][-1]))
    figure.supxlabel(_time_label(longest), fontsize=7.5)
    looks = _motion_looks(len(motions))
    for row, unit in enumerate(("m", "rad")):
        for k, (quantity, name) in enumerate(_NAMES[row].items()):
            axes, wanted = grid[row, k], []
            _time_axis(axes, longest, label=False)
            for motion, look in zip(motions.values(), looks, strict=True):
                axes.plot(motion["time"], trunk_values(motion)[row][:, k], **look)
                for when, target, tolerance in goals(motion).get(quantity, []):
                    wanted += [target - tolerance, target + tolerance]
                    axes.plot(
                        when,
                        target,
                        marker="o",
                        color=look["color"],
                        markersize=4,
                        markerfacecolor="white",
                        clip_on=False,
                        zorder=3,
                    )
            _at_least(axes, 0.02, wanted)
            axes.set_ylabel(f"{name} [{unit}]")
    goal = _line("goal", color=LIGHT.ink, linestyle="", marker="o", markersize=4, markerfacecolor="white")
    handles = [_line(name, **look) for name, look in zip(motions, looks, strict=True)] + [goal]
    _key(figure, handles, min(len(handles), 4))
    figure.align_ylabels()
    return figure


def _cost(progress: Progress, first_success: int | None) -> Any:
    figure, ((axes,),) = _figure(COLUMN, 2.5)
    trials = progress["trials"]
    low, high = _positive(progress["cost_generation_best"]), _positive(progress["cost_generation_worst"])
    high = np.where(np.isfinite(high), high, np.nanmax(np.where(np.isfinite(high), high, -np.inf)))
    axes.fill_between(
        trials, low, high, color=LIGHT.reference, alpha=0.25, linewidth=0, label="generation, best to worst"
    )
    axes.plot(
        trials,
        _positive(progress["cost_generation_median"]),
        color=LIGHT.reference,
        linewidth=0.9,
        linestyle=_STYLES[1],
        label="generation, median",
    )
    axes.plot(trials, _positive(progress["cost_best"]), color=LIGHT.best, linewidth=1.5, label="best so far")
    axes.set_yscale("log")
    axes.set_xlim(0.0, float(trials[-1]))
    _stages(axes, progress)
    handles, _ = axes.get_legend_handles_labels()
    if first_success is not None:
        best = float(np.interp(first_success, trials, _positive(progress["cost_best"])))
        axes.plot(
            first_success,
            best,
            marker="*",
            markersize=8,
            color=LIGHT.good,
            markeredgecolor="white",
            markeredgewidth=0.5,
            linestyle="",
            zorder=4,
        )
        handles.append(_line("first success", color=LIGHT.good, linestyle="", marker="*", markersize=7))
    _key(figure, handles, 2)
    axes.set_xlabel("trials")
    axes.set_ylabel("cost")
    return figure


def _stages(axes: Any, progress: Progress) -> None:
    """Draw a line where a stage begins, with the stage's name above it."""
    stages, trials, last = progress.stage, progress["trials"], float(progress["trials"][-1])
    changes = [i for i in range(len(stages)) if i == 0 or stages[i] != stages[i - 1]]
    taken = -math.inf
    for i in changes:
        start = float(trials[i - 1]) if i else 0.0
        if i:
            axes.axvline(start, color=LIGHT.muted, linewidth=0.7, dashes=(1, 2))
        width = 0.018 * (len(stages[i]) + 1)
        if start / last >= taken:
            edge = start / last + width > 1.0
            axes.text(
                1.0 if edge else start / last + 0.01,
                1.01,
                stages[i],
                transform=axes.transAxes,
                fontsize=6.5,
                color=LIGHT.muted,
                ha="right" if edge else "left",
                va="bottom",
            )
            taken = start / last + width


def _positive(values: Array) -> Array:
    return np.where(values > 0, values, np.nan)


def _costs(progress: Mapping[str, Progress]) -> Any:
    figure, ((axes,),) = _figure(COLUMN, 2.5)
    looks = _motion_looks(len(progress))
    for each, look in zip(progress.values(), looks, strict=True):
        axes.plot(each["trials"], _positive(each["cost_best"]), **look)
        for i in range(1, len(each.stage)):
            if each.stage[i] != each.stage[i - 1]:
                axes.plot(
                    each["trials"][i - 1],
                    each["cost_best"][i - 1],
                    marker="|",
                    markersize=8,
                    color=look["color"],
                    linestyle="",
                )
    axes.set_yscale("log")
    axes.set_xlim(0.0, max(float(each["trials"][-1]) for each in progress.values()))
    handles = [_line(name, **look) for name, look in zip(progress, looks, strict=True)]
    _key(figure, [*handles, _line("next stage", color=LIGHT.ink, linestyle="", marker="|", markersize=8)], 2)
    axes.set_xlabel("trials")
    axes.set_ylabel("best cost so far")
    return figure


def _joint_grid(motion: Motion) -> tuple[Any, list[tuple[Any, int, str]]]:
    """Make a column per leg and a row per joint. Returns the figure and its axes, joint indices and legs."""
    legs, names = motion.legs, motion.joint_names
    depth = max(len(leg.joints) for leg in legs)
    figure, grid = _figure(PAGE, 0.75 + 1.3 * depth, depth, len(legs), sharex=True)
    places = []
    for column, leg in enumerate(legs):
        for row in range(depth):
            axes = grid[row, column]
            if row >= len(leg.joints):
                axes.set_visible(False)
                continue
            joint = leg.joints[row]
            axes.set_title(f"{leg.name.upper()} {short(joint, leg.name)}")
            _time_axis(axes, motion, label=False)
            places.append((axes, names.index(joint), leg.name))
    figure.supxlabel(_time_label(motion), fontsize=7.5)
    return figure, places


def _beyond(axes: Any, low: float | None, high: float | None) -> None:
    """Shade the region beyond the limits, and show them."""
    bottom, top = axes.get_ylim()
    if low is not None and high is not None:
        room = 0.07 * (high - low)
        bottom, top = min(bottom, low - room), max(top, high + room)
        axes.set_ylim(bottom, top)
    for limit, edge in ((low, bottom), (high, top)):
        if limit is not None:
            axes.axhspan(limit, edge, facecolor=LIGHT.limit, alpha=0.22, linewidth=0, zorder=0.5)
            axes.axhline(limit, color=LIGHT.limit, linewidth=0.7, zorder=1)


def _shade_key() -> Any:
    from matplotlib.patches import Patch

    return Patch(facecolor=LIGHT.limit, alpha=0.35, label="beyond the limit")


def _joints(motion: Motion) -> Any:
    figure, places = _joint_grid(motion)
    limits, colours = motion.embodiment.limits, leg_colours(motion.legs, LIGHT)
    lower, upper = finite(limits.lower), finite(limits.upper)
    for axes, joint, leg in places:
        axes.plot(motion["time"], motion["joint_position"][:, joint], color=colours[leg])
        axes.plot(
            motion["time"],
            motion["joint_position_reference"][:, joint],
            color=LIGHT.measured,
            linewidth=0.9,
            linestyle=_STYLES[1],
        )
        _at_least(axes, 0.1)
        _beyond(axes, lower[joint], upper[joint])
    _label_rows(figure, places, "angle [rad]")
    reference = _line("reference", color=LIGHT.measured, linewidth=0.9, linestyle=_STYLES[1])
    _key(figure, [reference, _line("measured", color=colours[places[0][2]]), _shade_key()], 3)
    return figure


def _label_rows(figure: Any, places: Sequence[tuple[Any, int, str]], label: str) -> None:
    first = places[0][2]
    for axes, _, leg in places:
        if leg == first:
            axes.set_ylabel(label)
    figure.align_ylabels()


def _limited(motion: Motion, array: str, what: str, unit: str) -> Any:
    figure, places = _joint_grid(motion)
    limits = finite(getattr(motion.embodiment.limits, "torque" if what == "torque" else "velocity"))
    colours = leg_colours(motion.legs, LIGHT)
    for axes, joint, leg in places:
        axes.plot(motion["time"], motion[array][:, joint], color=colours[leg])
        _at_least(axes, 1.0)
        limit = limits[joint]
        _beyond(axes, None if limit is None else -limit, limit)
    _label_rows(figure, places, f"{what} [{unit}]")
    _key(figure, [_line(what, color=colours[places[0][2]]), _shade_key()], 2)
    return figure


def _foot_forces(motion: Motion) -> Any:
    figure, grid = _figure(COLUMN, 3.4, 2, 1, sharex=True)
    force, legs = motion["foot_contact_force"], [leg.name for leg in motion.legs]
    colours = leg_colours(motion.legs, LIGHT)
    looks = {leg: {"color": colours[leg], "linestyle": _STYLES[k % 4], "linewidth": 1.1} for k, leg in enumerate(legs)}
    for row, (values, label) in enumerate(
        ((force[..., 2], "vertical [N]"), (np.hypot(force[..., 0], force[..., 1]), "horizontal [N]"))
    ):
        axes = grid[row, 0]
        _time_axis(axes, motion, label=row == 1)
        for foot, look in enumerate(looks.values()):
            axes.plot(motion["time"], values[:, foot], **look)
        axes.set_ylim(min(0.0, float(values.min()) * 1.05), max(1.0, float(values.max()) * 1.05))
        axes.set_ylabel(label)
    handles = [_line(leg.upper(), **look) for leg, look in looks.items()]
    _key(figure, handles, len(handles))
    figure.align_ylabels()
    return figure


def _kernels(motion: Motion) -> Any:
    kernels, horizon = kernels_of(motion), motion.horizon
    weights = weights_of(motion, kernels)
    time = np.linspace(0.0, horizon, 301)
    phi, _ = kernels.basis(time, horizon)
    columns = 3 if len(weights) % 3 == 0 else 4
    rows = math.ceil(len(weights) / columns)
    from matplotlib.figure import Figure

    figure = Figure(figsize=(PAGE, 1.5 + 1.25 * rows), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.03, h_pad=0.03, wspace=0.02, hspace=0.03)  # type: ignore[union-attr]
    specification = figure.add_gridspec(rows + 1, columns, height_ratios=[1.0, *[1.0] * rows])
    top = figure.add_subplot(specification[0, :])
    for i in range(kernels.kernels):
        top.plot(time, phi[:, i], color=LIGHT.z if i % 2 == 0 else LIGHT.x, linestyle=_STYLES[i % 2], linewidth=0.9)
    top.set_title(f"{kernels.kernels} normalised kernels", loc="left")
    top.set_ylabel(r"$\varphi_i / \Sigma_j \varphi_j$ [-]")
    top.set_xlim(0.0, horizon)
    top.set_ylim(0.0, None)
    named = policy_names(motion, len(weights))
    for k, (w, name) in enumerate(zip(weights, named, strict=True)):
        axes = figure.add_subplot(specification[1 + k // columns, k % columns])
        axes.plot(time, phi @ w, color=LIGHT.measured)
        axes.plot(
            kernels.means * horizon,
            w,
            linestyle="",
            marker="o",
            markersize=3,
            color=LIGHT.x,
            markeredgecolor="white",
            markeredgewidth=0.4,
            zorder=3,
            clip_on=False,
        )
        axes.set_title(name)
        axes.set_xlim(0.0, horizon)
        _at_least(axes, 0.1)
        if k % columns == 0:
            axes.set_ylabel("angle [rad]")
        if k + columns >= len(weights):
            axes.set_xlabel("time [s]")
        else:
            axes.tick_params(labelbottom=False)
    handles = [
        _line("policy: desired angle", color=LIGHT.measured),
        _line(r"weights $w_i$ at the kernels' means $\mu_i$", color=LIGHT.x, linestyle="", marker="o", markersize=3),
    ]
    _key(figure, handles, 2)
    figure.align_ylabels()
    return figure
