"""Makes the pictures of the README and the manual from the shipped fits: `./run docs`."""

import io
from pathlib import Path

import matplotlib.pyplot as plt
import pandas
import recoil

root = Path(__file__).resolve().parents[2]
docs = root / "docs"


def fit(name):
    return recoil.fit(root / "fits" / f"{name}.toml")


def tutorial():
    """The fit of docs/tutorial.md: its table, with the columns named as recoil names them."""
    table = (docs / "tutorial.md").read_text().split("```csv\n")[1].split("```")[0]
    frame = pandas.read_csv(io.StringIO(table)).rename(columns={
        "size": "diameter", "V": "incident_velocity", "e": "restitution", "sd": "restitution_sd",
        "impacts": "events", "stuck": "captured"})
    return recoil.fit(frame, particle="polystyrene", surface="silicon", provenance="synthetic",
                      name="tutorial")


def drawn(axes):
    """A figure of matplotlib as SVG, the same bytes every time."""
    with plt.rc_context({"svg.hashsalt": "recoil"}):
        text = io.StringIO()
        axes.figure.savefig(text, format="svg", metadata={"Date": None}, bbox_inches="tight")
    plt.close(axes.figure)
    return "\n".join(line.rstrip() for line in text.getvalue().splitlines()) + "\n"


def forces(model):
    """Both forces of one impact against penetration."""
    history = model.impact(2.0, 4.9).history
    axes = plt.figure(figsize=(6, 3.6)).add_subplot()
    for name, label in (("hertz", "elastic"), ("adhesion", "adhesion")):
        force = [a + b for a, b in zip(history[f"{name}_force_uN"],
                                       history[f"{name}_damping_force_uN"])]
        axes.plot(history["penetration_nm"], force, label=label)
    axes.axhline(0.0, color="0.5", linewidth=0.8)
    axes.set(xlabel="penetration n [nm]", ylabel="force [µN], outward positive")
    axes.legend()
    return drawn(axes)


def energy(model):
    """Where the incident energy of impacts goes, against velocity."""
    velocities = [0.5 * 200 ** (k / 80) for k in range(81)]
    budgets = [model.impact(v, 4.9).contact.energy_J for v in velocities]
    names = {"rebound": "rebound", "adhesion_damping": "adhesion damping",
             "hertz_damping": "elastic damping"}
    axes = plt.figure(figsize=(6, 3.6)).add_subplot()
    axes.stackplot(velocities, *([100 * b[name] / b.incident for b in budgets] for name in names),
                   labels=names.values())
    axes.set(xscale="log", xlabel="incident velocity V [m/s]", ylabel="share of the energy [%]",
             xlim=(velocities[0], velocities[-1]), ylim=(0, 100))
    axes.legend(loc="center right")
    return drawn(axes)


def table_tennis():
    """The measured ball: e of every impact, and the mean with its interval for each surface."""
    axes = plt.figure(figsize=(6, 3.6)).add_subplot()
    for number, surface in enumerate(("table", "floor", "racket")):
        data = recoil.load_dataset(root / f"datasets/table-tennis-{surface}")
        points = data.to_pandas()
        mean = recoil.fit(data, replicates=0).restitution_summary[0]
        lower, upper = mean.interval
        axes.plot(points["incident_velocity"], points["restitution"], "osD"[number], markersize=4,
                  color=f"C{number}", label=f"{surface}: e = {mean.value:.3f} ± {(upper - lower) / 2:.3f}")
        axes.axhspan(lower, upper, color=f"C{number}", alpha=0.2, linewidth=0)
    axes.set(xlabel="incident velocity V [m/s]", ylabel="restitution e", ylim=(0.2, 1.0))
    axes.legend(loc="lower right")
    return drawn(axes)


quartz, silicon, molybdenum = map(fit, ("dahneke1975-quartz", "wall1990-silicon",
                                        "wall1990-molybdenum"))
steel = fit("li1999-sst65-silicon").predict(root / "datasets/li1999-sst65-silicon/sizes.csv")
pictures = {
    docs / "pictures/forces.svg": forces(molybdenum),
    docs / "pictures/energy.svg": energy(molybdenum),
    root / "reports/pictures/dahneke1975-quartz.svg": quartz.svg("restitution-1"),
    docs / "pictures/restitution.svg": quartz.svg("restitution-1"),
    docs / "pictures/sizes.svg": silicon.svg("overview"),
    docs / "pictures/residuals.svg": molybdenum.svg("residuals-1"),
    docs / "pictures/capture.svg": molybdenum.svg("capture-models-1"),
    docs / "pictures/mixture.svg": steel.svg("mixture-average-1"),
    docs / "pictures/diagnosis.svg": molybdenum.diagnose().svg("before-after-0"),
    docs / "pictures/tutorial.svg": tutorial().svg("overview"),
    docs / "pictures/table-tennis.svg": table_tennis(),
}
for file, picture in pictures.items():
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(picture)
    print(file.relative_to(root))
