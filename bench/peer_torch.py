#!/usr/bin/python3
"""The flow in plain eager PyTorch, as a user would run it, from the same checkpoint.

    peer_torch.py FOLDER      what `engine_bench --probes FOLDER` wrote

For each model it steps the probe's inputs, fails unless the features equal the engine's, and then
measures frames a second of one thread by its CPU time, in float32 and with networks of bfloat16.
Prints JSON.
"""
import json
import math
import statistics
import sys
import time
from pathlib import Path

import numpy
import torch

TOLERANCE = 1e-4
BATCHES = (1, 8, 32, 64)
REPETITIONS = 5
LEAST_SECONDS = 0.4  # of a repetition


def read_safetensors(path):
    data = Path(path).read_bytes()
    length = int.from_bytes(data[:8], "little")
    header = json.loads(data[8:8 + length])
    metadata = header.pop("__metadata__", {})
    tensors = {}
    for name, entry in header.items():
        begin, end = (8 + length + offset for offset in entry["data_offsets"])
        if entry["dtype"] == "BF16":  # the upper half of a float32
            values = (numpy.frombuffer(data[begin:end], numpy.uint16).astype(numpy.uint32) << 16).view(numpy.float32)
        else:
            values = numpy.frombuffer(data[begin:end], numpy.float32)
        tensors[name] = torch.from_numpy(values.reshape(entry["shape"]).copy())
    return tensors, metadata


class Coupling(torch.nn.Module):
    """The network [a, b] = f(z_lo, condition) of one step, and that step's inverse."""

    def __init__(self, tensors, config, width, precision):
        super().__init__()
        self.precision = precision
        self.low = width // 2
        get = lambda name: tensors[name]
        weight = get("permutation") @ (torch.tril(get("lower"), -1) + torch.eye(width)) @ (
            torch.triu(get("upper"), 1) + torch.diag(get("sign") * get("log_diagonal").exp()))
        self.unmix = torch.inverse(weight.double()).t().float().contiguous()
        self.bias, self.log_scale = get("norm_bias"), get("norm_log_scale")
        self.log_det = (self.log_scale.sum() + get("log_diagonal").sum()).item()
        network = {name[len("network."):]: value for name, value in tensors.items()
                   if name.startswith("network.")}
        inputs = network["lstm.weight_ih_l0"].shape[1]
        self.lstm = torch.nn.LSTM(inputs, config["hidden"], 2, batch_first=True)
        self.last = torch.nn.Linear(*reversed(network["last.weight"].shape))
        self.load_state_dict(network)
        self.to(precision)

    def inverse(self, z, condition, state):
        low, high = z[:, :self.low], z[:, self.low:]
        x = torch.cat([low, condition], 1).to(self.precision)
        x, state = self.lstm(x.unsqueeze(1), state)
        a, b = self.last(x.squeeze(1)).float().chunk(2, 1)
        delta = 0.05 + 0.95 * torch.sigmoid(b + 2)
        high = (high - (1 - delta) * a) / delta
        z = torch.cat([low, high], 1) @ self.unmix * (-self.log_scale).exp() - self.bias
        return z, state, self.log_det + delta.log().sum(1)


class Flow:
    """`precision`: of the networks; the path from noise to features is always float32."""

    def __init__(self, path, precision=torch.float32):
        self.tensors, metadata = read_safetensors(path)
        self.config = json.loads(metadata["config"])
        self.width = len(self.tensors["feature_mean"])
        self.steps = []
        for k in range(self.config["flow_steps"]):
            prefix = f"flow.steps.{k}."
            self.steps.append(Coupling({name[len(prefix):]: value for name, value in self.tensors.items()
                                        if name.startswith(prefix)}, self.config, self.width, precision))
        self.precision = precision
        self.layers = {name: (self.tensors[name + ".weight"].to(precision), self.tensors[name + ".bias"].to(precision))
                       for name in ("encode_past", "encode_audio", "encode") if name + ".weight" in self.tensors}

    def linear(self, name, x):
        return torch.nn.functional.linear(x.to(self.precision), *self.layers[name]).float()

    def condition(self, past, audio, static):
        if self.config["condition_width"] == 0:
            return torch.cat([past, audio, static], 1)
        silu = torch.nn.functional.silu
        hidden = silu(self.linear("encode_past", past) + self.linear("encode_audio", audio) + static)
        return silu(self.linear("encode", hidden))

    def step(self, past, audio, has_audio, static, noise, states):
        t = self.tensors
        past = ((past - t["feature_mean"]) / t["feature_std"]).clamp(-6, 6)
        past = past.flatten(1)
        audio = ((audio - t["audio_mean"]) / t["audio_std"]).clamp(-6, 6) * has_audio.view(-1, 1, 1)
        condition = self.condition(past, torch.cat([audio.flatten(1), has_audio.view(-1, 1)], 1), static)
        z = noise
        log_likelihood = -0.5 * (noise.square().sum(1) + self.width * math.log(2 * math.pi))
        for k in reversed(range(len(self.steps))):
            z, states[k], log_det = self.steps[k].inverse(z, condition, states[k])
            log_likelihood = log_likelihood + log_det
        beyond = (z.abs() - 3).clamp_min(0)  # bending outliers counts, too: 2 log cosh of what is beyond
        log_likelihood = log_likelihood + 2 * (beyond + torch.log1p((-2 * beyond).exp()) - math.log(2)).sum(1)
        inside = z.clamp(-3, 3)
        return (inside + (z - inside).tanh()) * t["feature_std"] + t["feature_mean"], log_likelihood


def largest_difference(flow, probe):
    largest, states = 0, [None] * len(flow.steps)
    for frame in range(probe["static_condition"].shape[1]):
        get = lambda name: probe[f"{name}.{frame}"]
        features, log_likelihood = flow.step(get("past"), get("audio"), get("has_audio"),
                                             probe["static_condition"][:, frame], get("noise"), states)
        relative = (log_likelihood - get("log_likelihood")).abs() / log_likelihood.abs().clamp_min(1)
        largest = max(largest, (features - get("features")).abs().max().item(), relative.max().item())
    return largest


def frames_a_second(flow, probe, batch):
    rows = lambda tensor: tensor[:1].repeat(batch, *[1] * (tensor.dim() - 1))
    inputs = [rows(probe[name + ".0"]) for name in ("past", "audio", "has_audio")]
    inputs += [rows(probe["static_condition"][:, 0]), rows(probe["noise.0"])]
    states = [None] * len(flow.steps)
    flow.step(*inputs, states)
    rates = []
    for _ in range(REPETITIONS):
        frames, begin = 0, time.thread_time()
        while time.thread_time() - begin < LEAST_SECONDS:
            flow.step(*inputs, states)
            frames += batch
        rates.append(frames / (time.thread_time() - begin))
    return statistics.median(rates)


def main(folder):
    torch.set_num_threads(1)
    torch.set_flush_denormal(True)
    report = {"torch": torch.__version__}
    with torch.inference_mode():
        for model in ("paper",):
            flow = Flow(Path(folder) / f"{model}.safetensors")
            probe, _ = read_safetensors(Path(folder) / f"{model}.probe.safetensors")
            difference = largest_difference(flow, probe)
            if not difference < TOLERANCE:
                sys.exit(f"peer_torch.py: {model}: differs from the engine by {difference:.2g}, more than {TOLERANCE:g}")
            half = Flow(Path(folder) / f"{model}.safetensors", torch.bfloat16)
            report[model] = {"largest_difference": difference,
                             "largest_difference_bf16": largest_difference(half, probe),
                             "frames_a_second": {n: frames_a_second(flow, probe, n) for n in BATCHES},
                             "frames_a_second_bf16": {n: frames_a_second(half, probe, n) for n in BATCHES}}
    print(json.dumps(report, indent=1))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
