#!/usr/bin/python3
"""Writes docs/performance.md from one run of the benchmarks, and compares with the committed figures.

    report.py ENGINE.json PEER.json ROOT

ENGINE.json: engine_bench's (medians), PEER.json: peer_torch.py's. Figures are kept in ROOT/bench/figures.json.
"""
import json
import sys
from pathlib import Path

STREAMS = (1, 8, 32, 64)


def engine_figures(report):
    """items a second by benchmark, bytes a second of the memory."""
    figures = {}
    for run in report["benchmarks"]:
        if run.get("aggregate_name") != "median":
            continue
        name = run["run_name"]
        figures[name] = run["bytes_per_second"] if name == "memory" else run["items_per_second"]
    return figures


def megabytes_of_weights(report, model):
    for run in report["benchmarks"]:
        if run["run_name"] == f"{model}/bare/1" and run.get("aggregate_name") == "median":
            return run["bytes_per_second"] / run["items_per_second"] / 1e6


def tables(figures, weights):
    lines = []
    for model, of in (("default", "the model that ships"), ("paper", "paper F's size, random weights")):
        lines += [f"`{model}` ({of}), frames a second:", "",
                  "| streams | packed engine | torch engine | eager PyTorch | bare products | packed ÷ eager | packed ÷ bare |",
                  "|---|---|---|---|---|---|---|"]
        for n in STREAMS:
            packed, torch, peer, bare = (figures[f"{model}/{what}/{n}"] for what in ("packed", "torch", "peer", "bare"))
            lines.append(f"| {n} | {packed:,.0f} | {torch:,.0f} | {peer:,.0f} | {bare:,.0f} | "
                         f"{packed / peer:.1f}x | {packed / bare:.2f} |")
        lines.append("")
    best = max(figures[f"paper/peer/{n}"] for n in STREAMS)
    rate, memory = figures["paper/packed/1"], figures["memory"] / 1e6
    lines += ["| figure | measured | at least | aim |", "|---|---|---|---|",
              f"| `paper`, 1 stream ÷ eager PyTorch | {rate / figures['paper/peer/1']:.1f}x | 8x | 15x |",
              f"| `paper`, 1 stream ÷ bare oneDNN loop over the same bytes | {rate / figures['paper/bare/1']:.2f} | 0.70 | 0.85 |",
              f"| `paper`, 32 streams ÷ eager PyTorch at its best batch | {figures['paper/packed/32'] / best:.1f}x | 50x | 120x |",
              f"| `paper`, 32 streams ÷ bare product loop | {figures['paper/packed/32'] / figures['paper/bare/32']:.2f} | 0.65 | 0.8 |",
              "",
              f"Limit of one stream of `paper`: a frame reads {weights:,.0f} MB of weights, memory gives {memory / 1e3:.1f} GB/s, that is "
              f"{memory / weights:.0f} frames a second; reached: {100 * rate * weights / memory:.0f} %.",
              f"Admission of 60 frames (the plan, and what is computed ahead): {1e3 / figures['default/admission']:.1f} ms `default`, "
              f"{1e3 / figures['paper/admission']:.1f} ms `paper`.", ""]
    return lines


def main(engine_path, peer_path, root):
    engine = json.loads(Path(engine_path).read_text())
    peer = json.loads(Path(peer_path).read_text())
    figures = engine_figures(engine)
    for model in ("default", "paper"):
        for n, rate in peer[model]["frames_a_second"].items():
            figures[f"{model}/peer/{n}"] = rate
    context = engine["context"]
    lines = ["# Performance", "",
             "Written by `make bench`; do not edit. Frames a second of CPU time, on **one thread**, float32, medians of 5 interleaved repetitions. "
             "The engines' frames are whole: windows, noise and poses included; eager PyTorch (`bench/peer_torch.py`) and the bare products "
             "(oneDNN, on weights that it packed) have the network alone. Compare figures of one run only: a busy neighbour shares "
             "caches and memory.", "",
             f"Kernels {context['kernels']}; BLAS {context['blas']}; PyTorch {peer['torch']}; largest difference between the packed engine and eager PyTorch "
             f"{max(peer[m]['largest_difference'] for m in ('default', 'paper')):.1g}. Load of the machine when it began: "
             f"{context['load_avg'][0]:.1f} on {context['num_cpus']} cores.", ""]
    lines += tables(figures, megabytes_of_weights(engine, "paper"))
    lines += ["```", "make bench", "```"]
    committed = Path(root) / "bench/figures.json"
    if committed.exists():
        before = json.loads(committed.read_text())
        print("ratio to the committed figures:")
        for name in sorted(figures):
            if name in before:
                print(f"  {name:24} {figures[name] / before[name]:.2f}")
    committed.write_text(json.dumps(figures, indent=1, sort_keys=True) + "\n")
    (Path(root) / "docs/performance.md").write_text("\n".join(lines) + "\n")
    print("\n".join(lines))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
