#!/usr/bin/python3
"""Writes docs/performance.md and bench/figures.json from one run of the benchmarks, and compares with the committed figures.

    report.py FOLDER ROOT

FOLDER holds engine.json (engine_bench's medians), avx2.json (with --kernels avx2), peer.json (peer_torch.py's), and what `load` printed:
load.md with the server's defaults, room.md with room for many dances, paper.md with the model of paper F's size, avx2.md with AVX2's kernels.
The page is what is to be reached, and ROOT/bench/notes.md, which says what eats the rest; figures.json has everything.
"""
import json
import sys
from pathlib import Path

LIVE_LATENESS = 33.3  # ms, a frame
FRAMES_OF_PLAN = 60  # of a transition that engine_bench samples
BESIDE = {  # what is beside one live dance, and the rows of load's tables that are of it
    "greedy calls": ["1800 frames, 32 candidates, again and again", "600 frames, 32 candidates, again and again",
                     "300 frames, 8 candidates, again and again", "5,000 times 1800 frames, 32 candidates, with 1 ms each"],
    "dragged keys": ["8 dances with 30 edits a second each"],
}


def engine_figures(report):
    """items a second by benchmark, bytes a second of the memory."""
    figures = {}
    for run in report["benchmarks"]:
        if run.get("aggregate_name") != "median":
            continue
        name = run["run_name"].removesuffix("/real_time")
        figures[name] = run["bytes_per_second"] if name == "memory" else run["items_per_second"]
        if "flops" in run:
            figures[name + "/flops"] = run["flops"]
    return figures


def table_rows(text, first_column):
    """The rows of the table whose first column has that name, as lists of words."""
    rows, inside = [], False
    for line in text.splitlines():
        if line.startswith(f"| {first_column} "):
            inside = True
        elif inside and line.startswith("|---"):
            continue
        elif inside and line.startswith("|"):
            rows.append([cell.strip() for cell in line.strip("|").split("|")])
        elif not line.strip():
            inside = False  # other lines are a program's messages
    return rows


def load_figures(text, room, paper, avx2):
    figures = {}
    for line in room.splitlines():
        if "idle streams:" in line:
            figures["load/idle KiB"] = float(line.split(":")[1].split()[0])
    for where, of in (("live", text), ("room", room), ("live avx2", avx2)):
        for streams, addresses, admitted, *_, first, _, _, late, _, missed, _, _ in table_rows(of, "streams"):
            if addresses == "1":
                name = f"load/{where}/{streams}"
                figures |= {f"{name}/first p99 ms": float(first), f"{name}/p99 ms": float(late), f"{name}/admitted": int(admitted),
                            f"{name}/missed %": float(missed)}
    for where, of in (("beside", text), ("beside avx2", avx2)):
        for others, _, _, late, *_ in table_rows(of, "beside one live dance"):
            figures[f"load/{where}/{others}/p99 ms"] = float(late)
    for row in table_rows(text, "dances at once,"):
        figures[f"load/closed/{row[0]}"] = float(row[2])
    for row in table_rows(paper, "dances at once,"):
        figures[f"load/paper/closed/{row[0]}"] = float(row[2])
    for _, _, first in table_rows(text, "a dance without a server"):
        figures["load/start/first frame ms"] = float(first)
    minutes = table_rows(text, "minute")
    if len(minutes) == 2:
        figures["load/minute 10 ÷ 1, time"] = float(minutes[1][1]) / float(minutes[0][1])
        figures["load/minute 10 ÷ 1, memory"] = float(minutes[1][2]) / float(minutes[0][2])
    return figures


def kinds_of(figures):
    kinds = [("float32", "packed", "bare", "peer")]
    if "paper/packed-bf16" in figures:
        kinds.append(("bfloat16", "packed-bf16", "bare-bf16", "peer-bf16"))
    return kinds


def tables_of(text):
    """All tables of a text, each a list of rows by the names of its columns."""
    tables, names = [], None
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not line.strip():
            names = None
        elif not line.startswith("|"):
            continue  # a program's message
        elif names is None:
            names, of = [], ""
            for cell in cells:  # "frames p50 ms | p99 | max": of frames, all three
                of = cell.removesuffix("p50 ms") if cell.endswith("p50 ms") else of
                names.append(of + cell if cell in ("p95", "p99", "max") else cell)
            tables.append([])
        elif not line.startswith("|---"):
            tables[-1].append(dict(zip(names, cells)))
    return tables


def memory_figures(figures, report):
    """The share of memory bandwidth that paper F's flow reaches: every frame reads every weight."""
    reached = {}
    for _, packed, bare, _ in kinds_of(figures):
        for run in report["benchmarks"]:
            if run["run_name"] == f"paper/{bare}" and run.get("aggregate_name") == "median":
                weights = run["bytes_per_second"] / run["items_per_second"]
                reached[f"paper/{packed} ÷ what memory gives"] = figures[f"paper/{packed}"] * weights / figures["memory"]
    return reached


def bars(figures, gpu):
    """The table of targets: figure, measured, at least, aim, whether more is better. `gpu`: what gpu_row takes."""
    served = kinds_of(figures)[-1]
    packed, bare = served[1], served[2]
    frames = FRAMES_OF_PLAN * figures[f"paper/{packed}"]
    live = sorted((int(name.split("/")[2]), value) for name, value in figures.items()
                  if name.startswith("load/room/") and name.endswith("/p99 ms") and "first" not in name)
    within = max((streams for streams, p99 in live if p99 < LIVE_LATENESS), default=0)
    rows = [
        ("`paper`, frames ÷ eager PyTorch's of one stream (float32)", frames / figures["paper/peer/1"], 8, 15, "x"),
        ("`paper` ÷ bare oneDNN loop over the same bytes", figures[f"paper/{packed}"] / figures[f"paper/{bare}"], 0.7, 0.85, ""),
    ]
    if served[3] != "peer":
        rows.insert(1, ("`paper`, frames ÷ eager PyTorch's in the same bfloat16", frames / figures[f"paper/{served[3]}/1"], 8, 15, "x"))
    sampled = figures[f"default/{packed}"]
    rows.append((f"`default`: {FRAMES_OF_PLAN} frames sampled, ms", 1e3 / sampled, 8, 3, "ms"))
    rows.append((f"`default`: {FRAMES_OF_PLAN} frames sampled ÷ its bare products", sampled / figures[f"default/{bare}"], 0.7, 0.85, ""))
    rows.append(("`default`: to beats ÷ without, time", sampled / figures[f"default/to_beats/{packed}"], 1.5, 1.3, "less"))
    through = figures.get("load/paper/closed/32")
    rows.append(("`paper` through gRPC ÷ engine alone, 32 streams, by CPU time", through and through / frames, 0.9, 0.97, ""))
    if "load/closed/32" in figures:
        rows.append(("`default` through gRPC, with its music ÷ engine alone, 32 streams, by CPU time",
                     figures["load/closed/32"] / (FRAMES_OF_PLAN * sampled), 0.6, 0.8, ""))
        # The same work on both sides: dances to music are timed to its beats.
        to_beats = FRAMES_OF_PLAN * figures[f"default/to_beats/{packed}"]
        rows.append(("the same ÷ engine alone, to beats", figures["load/closed/32"] / to_beats, 0.6, 0.8, ""))
    if live:
        rows.append((f"`default`: streams (sizes tried) with p99 lateness under {LIVE_LATENESS} ms", within, 200, 500, ""))
    rows.append(("a dance without a server: start to first frame, ms", figures.get("load/start/first frame ms"), 1500, 500, "ms"))
    if "load/live/50/first p99 ms" in figures:
        rows.append(("first frame after the audio that allows it, 50 streams, p99, ms", figures["load/live/50/first p99 ms"], 100, 30, "ms"))
    for kernels, where in (("", ""), (", AVX2", " avx2")):
        if f"load/live{where}/100/admitted" in figures:
            rows.append((f"missed frames of 100 dances offered, {figures[f'load/live{where}/100/admitted']} admitted{kernels}, %",
                         figures[f"load/live{where}/100/missed %"], 0.1, 0, "%"))
    for what, tables in BESIDE.items():
        late = [figures[f"load/beside/{others}/p99 ms"] for others in tables if f"load/beside/{others}/p99 ms" in figures]
        if late:
            rows.append((f"one live dance beside {what}, p99 lateness, ms", max(late), 50, 33, "ms"))
    if "load/idle KiB" in figures:
        rows.append(("memory per idle stream, KiB", figures["load/idle KiB"], 256, 64, "KiB"))
    for name in ("load/minute 10 ÷ 1, time", "load/minute 10 ÷ 1, memory"):
        if name in figures:
            rows.append((name.removeprefix("load/"), figures[name], 1.0, 1.0, "≤"))
    lines = ["| figure | measured | at least | aim | reached |", "|---|---|---|---|---|"]
    for what, value, least, aim, unit in rows:
        if value is None:
            lines.append(f"| {what} | not measured | {least} | {aim} | |")
            continue
        less = unit in ("ms", "KiB", "≤", "less", "%")
        slack = 1.02 if unit == "≤" else 1
        good = [value <= bar * slack if less else value >= bar for bar in (least, aim)]
        shown = f"{value:.1f}x" if unit == "x" else f"{value:.0f}" if value >= 10 else f"{value:.2f}"
        lines.append(f"| {what} | {shown} | {least} | {aim} | {'aim' if good[1] else 'yes' if good[0] else '**no**'} |")
    return lines + [gpu_row(*gpu), ""]


def kinds_of_cpu(figures, elsewhere):
    """`default` on each kind of CPU. `elsewhere`: bench/gpu.json, whose machine has AMX."""
    amx = elsewhere["figures"]
    kinds = [("AVX2", "avx2/default/packed", "avx2/default/bare", "avx2/default/to_beats/packed", 0.75),
             ("AVX-512", "default/packed", "default/bare", "default/to_beats/packed", None),
             ("AVX-512 bf16", "default/packed-bf16", "default/bare-bf16", "default/to_beats/packed-bf16", 0.7)]
    rows = [(name, 1e3 / figures[packed], figures[packed] / figures[bare], least, figures[packed] / figures[beats])
            for name, packed, bare, beats, least in kinds if packed in figures and bare in figures and beats in figures]
    packed = amx["default/admission/packed-bf16"]
    rows.append(("AMX", 1e3 / packed, packed / amx["default/bare-bf16"], 0.6, None))
    lines = ["| `default`, 60 frames, on | ms | ÷ its bare products | at least | to beats ÷ without |", "|---|---|---|---|---|"]
    for name, ms, share, least, beats in rows:
        lines.append(f"| {name} | {ms:.1f} | {share:.2f} | {least or ''} | {f'{beats:.2f}' if beats else '?'} |")
    return lines + ["", f"AMX is another machine, measured on {elsewhere['date']}; the others are this one.", ""]


def gpu_row(figures, gpu):
    """The card and its measurements; the bars are for one of H200's class."""
    rate, least, aim = FRAMES_OF_PLAN * figures["paper/cuda/torch"], 1500, 4000
    return f"| {gpu}, `paper`, frames/s | {rate:,.0f} | {least:,} | {aim:,} | {'aim' if rate >= aim else 'yes' if rate >= least else '**no**'} |"


def main(folder, root):
    folder, root = Path(folder), Path(root)
    engine = json.loads((folder / "engine.json").read_text())
    peer = json.loads((folder / "peer.json").read_text())
    load, room, paper, avx2 = ((folder / f"{name}.md").read_text() if (folder / f"{name}.md").exists() else "" for name in ("load", "room", "paper", "avx2"))
    figures = engine_figures(engine) | load_figures(load, room, paper, avx2)
    if (folder / "avx2.json").exists():
        figures |= {f"avx2/{name}": value for name, value in engine_figures(json.loads((folder / "avx2.json").read_text())).items()}
    for name in ("peer", "peer-bf16"):
        for n, rate in peer["paper"]["frames_a_second" + ("_bf16" if "bf16" in name else "")].items():
            figures[f"paper/{name}/{n}"] = rate
    figures |= memory_figures(figures, engine)
    context = engine["context"]
    measured = ["", "## How it is measured", "",
                "`make bench` writes this page. Engines run on **one thread**: transitions of 60 frames by CPU time, medians of 5 interleaved repetitions, whole, "
                "with windows, noise and poses. Eager PyTorch (`bench/peer_torch.py`, the same checkpoint) and the bare products (oneDNN) have the network alone. "
                "Servers have their defaults, and share the cores with their clients. Compare figures of one run only: a busy neighbour shares caches and memory.", "",
                f"Kernels {context['kernels']}; {context['blas'].split(' NO_')[0]}; PyTorch {peer['torch']}, whose results differ by at most "
                f"{peer['paper']['largest_difference']:.1g}; load {context['load_avg'][0]:.1f} on {context['num_cpus']} cores when it began."]
    elsewhere = json.loads((root / "bench/gpu.json").read_text())  # for runs where there is none
    gpu = (figures, context["gpu"]) if "gpu" in context else (elsewhere["figures"], elsewhere["gpu"])
    lines = ["# Performance", "", *bars(figures, gpu), *kinds_of_cpu(figures, elsewhere), (root / "bench/notes.md").read_text().strip(), *measured]
    committed = root / "bench/figures.json"
    if committed.exists():
        before = json.loads(committed.read_text())["figures"]
        print("ratio to the committed figures:")
        for name in sorted(figures):
            if before.get(name):
                print(f"  {name:32} {figures[name] / before[name]:.2f}")
    tables = {name: tables_of(text) for name, text in (("load", load), ("load, with room for many", room), ("load, paper", paper), ("load, AVX2", avx2))}
    committed.write_text(as_json(figures, tables))
    (root / "docs/performance.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


def as_json(figures, tables):
    """One figure, or one table row, per line."""
    rows = ["[\n   " + ",\n   ".join(json.dumps(row, ensure_ascii=False) for row in table) + "\n  ]" for of in tables.values() for table in of]
    names = [f"{name}, {at + 1}" for name, of in tables.items() for at in range(len(of))]
    body = ",\n".join(f"  {json.dumps(name)}: {table}" for name, table in zip(names, rows))
    return f'{{"figures": {json.dumps(figures, indent=1, sort_keys=True, ensure_ascii=False)},\n "tables": {{\n{body}\n }}\n}}\n'


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
