#!/usr/bin/python3
"""Draws docker/grafana.json with Prometheus' answers for a choreod under mixed load.

    scripts/draw_dashboard.py BUILD_DIRECTORY PICTURE [--minutes 4]

`soak` plays the load: dances in real time beside clients that crash, fall silent and want too much. A Prometheus of its own scrapes the
server. Every query of every panel is evaluated over the whole time; one that has nothing to show is an error. Needs Debian's prometheus
and python3-matplotlib. Everything stays on this machine.
"""
import argparse
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time
import urllib.parse
import urllib.request

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parent.parent
SCRAPE_S = 2
GRID_COLUMNS = 24  # of Grafana's dashboards
ROW_INCHES = 0.32
UNITS = {"percentunit": matplotlib.ticker.PercentFormatter(1), "s": matplotlib.ticker.EngFormatter("s"),
         "lengthm": matplotlib.ticker.EngFormatter("m"), "bytes": matplotlib.ticker.EngFormatter("B")}
COLOURS = 24  # of the picture, which stays small


def free_port():
    with socket.socket() as one:
        one.bind(("127.0.0.1", 0))
        return one.getsockname()[1]


def ask(port, path, **parameters):
    url = f"http://127.0.0.1:{port}/{path}?{urllib.parse.urlencode(parameters)}"
    with urllib.request.urlopen(url, timeout=10) as answer:
        return json.load(answer)


def is_ready(port):
    try:
        with urllib.request.urlopen(f"http://127.0.0.1:{port}/-/ready", timeout=1):
            return True
    except OSError:
        return False


def record(build, minutes, folder):
    """Plays the load. Returns Prometheus' process and port, and when the load began and ended."""
    metrics, port = free_port(), free_port()
    config = folder / "prometheus.yml"
    config.write_text(json.dumps({  # which is YAML, too
        "global": {"scrape_interval": f"{SCRAPE_S}s"},
        "scrape_configs": [{"job_name": "choreod", "static_configs": [{"targets": [f"127.0.0.1:{metrics}"]}]}],
    }))
    prometheus = subprocess.Popen(
        ["prometheus", f"--config.file={config}", f"--storage.tsdb.path={folder / 'data'}",
         f"--web.listen-address=127.0.0.1:{port}", "--log.level=error"])
    while not is_ready(port):
        if prometheus.poll() is not None:
            sys.exit("prometheus did not start")
        time.sleep(0.2)
    begin = time.time()
    load = subprocess.run([build / "bin/soak", "--minutes", str(minutes)],
                          env={**os.environ, "CHOREO_METRICS": str(metrics)}, check=False)
    if load.returncode != 0:
        sys.exit("soak failed")
    return prometheus, port, begin, time.time()


def name_of(template, labels):
    for key, value in labels.items():
        template = template.replace("{{" + key + "}}", value)
    return template


def draw(panel, axes, port, begin, end):
    """Returns queries without data."""
    empty = []
    for target in panel["targets"]:
        # As Grafana fills them in: all jobs, four scrapes.
        query = target["expr"].replace("$job", ".*").replace("$__rate_interval", f"{4 * SCRAPE_S}s")
        answer = ask(port, "api/v1/query_range", query=query, start=begin, end=end, step=SCRAPE_S)
        found = [[(float(t) - begin, float(v)) for t, v in one["values"] if v != "NaN"]
                 for one in answer["data"]["result"]]
        if not any(found):
            empty.append(query)
        for one, points in zip(answer["data"]["result"], found):
            if points:
                axes.plot(*zip(*points), linewidth=1, label=name_of(target["legendFormat"], one["metric"]))
    defaults = panel["fieldConfig"]["defaults"]
    custom = defaults["custom"]
    if custom.get("scaleDistribution", {}).get("type") == "log":
        axes.set_yscale("log")
    else:
        axes.set_ylim(bottom=defaults.get("min"))
    if "axisSoftMax" in custom:
        axes.set_ylim(top=max(axes.get_ylim()[1], custom["axisSoftMax"]))
    axes.yaxis.set_major_formatter(UNITS.get(defaults["unit"], matplotlib.ticker.StrMethodFormatter("{x:g}")))
    axes.set_xlim(0, end - begin)
    axes.xaxis.set_major_formatter(lambda second, _: f"{second / 60:.0f} min")
    axes.xaxis.set_major_locator(matplotlib.ticker.MultipleLocator(60))
    axes.set_title(panel["title"], fontsize=8, loc="left")
    axes.tick_params(labelsize=6)
    axes.grid(linewidth=0.3)
    axes.legend(fontsize=6, loc="upper center", bbox_to_anchor=(0.5, -0.1), ncols=3, frameon=False)
    return empty


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("picture", type=pathlib.Path)
    parser.add_argument("--minutes", type=float, default=4)
    arguments = parser.parse_args()
    panels = json.loads((ROOT / "docker/grafana.json").read_text())["panels"]
    rows = max(panel["gridPos"]["y"] + panel["gridPos"]["h"] for panel in panels)
    figure = plt.figure(figsize=(12, rows * ROW_INCHES), layout="constrained")
    grid = figure.add_gridspec(rows, GRID_COLUMNS)
    empty = []
    with tempfile.TemporaryDirectory() as folder:
        prometheus, port, begin, end = record(arguments.build.resolve(), arguments.minutes, pathlib.Path(folder))
        try:
            for panel in panels:
                at = panel["gridPos"]
                axes = figure.add_subplot(grid[at["y"]:at["y"] + at["h"], at["x"]:at["x"] + at["w"]])
                empty += draw(panel, axes, port, begin, end)
        finally:
            prometheus.terminate()
            prometheus.wait()
    figure.savefig(arguments.picture, dpi=64)
    Image.open(arguments.picture).convert("RGB").quantize(COLOURS).save(arguments.picture, optimize=True)
    if empty:
        sys.exit("nothing to show: " + "; ".join(empty))


if __name__ == "__main__":
    main()
