"""Makes the pictures of the README and the manual from the shipped fits: `./run docs`."""

import io
from pathlib import Path

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


quartz, silicon, molybdenum = map(fit, ("dahneke1975-quartz", "wall1990-silicon",
                                        "wall1990-molybdenum"))
steel = fit("li1999-sst65-silicon").predict(root / "datasets/li1999-sst65-silicon/sizes.csv")
pictures = {
    root / "reports/pictures/dahneke1975-quartz.svg": quartz.svg("restitution-1"),
    docs / "pictures/restitution.svg": quartz.svg("restitution-1"),
    docs / "pictures/sizes.svg": silicon.svg("overview"),
    docs / "pictures/residuals.svg": molybdenum.svg("residuals-1"),
    docs / "pictures/capture.svg": molybdenum.svg("capture-models-1"),
    docs / "pictures/mixture.svg": steel.svg("mixture-average-1"),
    docs / "pictures/diagnosis.svg": molybdenum.diagnose().svg("before-after-0"),
    docs / "pictures/tutorial.svg": tutorial().svg("overview"),
}
for file, picture in pictures.items():
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(picture)
    print(file.relative_to(root))
