#!/usr/bin/env python3
"""Recordings by another program, and what `odolab diagnose` makes of them.

    test/tools/third_hand.py build/release/odolab SEED [SEED...] [--effects none,bump] [--noises exact,white] [--size 1]

A robot on paper that shares no line with OdoLab: wheel speeds by ramps, the midpoint rule in steps of 2 ms, counts cut
off (not rounded to the middle), truth and encoders at rates of their own, clock and marker off by a random choice, a
vehicle file that is some per cent wrong. One line a case: OK, MISS (nothing was named) or BAD (something else was).
"""
import argparse
import json
import math
import os
import random
import subprocess
import tempfile
from concurrent.futures import ThreadPoolExecutor

SIZES = {  # of size 1
    "none": 0.0, "wheel_eccentricity": 0.004, "encoder_missed_counts": 0.01, "drivetrain_backlash": 0.03,
    "wheel_toe": 0.01, "castor_reversal_kick": 0.01, "radius_drift": 1e-4, "tyre_compression": 2e-4,
    "speed_dependent_radius": 0.01, "payload_radius_change": 0.004, "lateral_slip": 0.01, "traction_slip": 0.01,
    "turn_scrub": 0.01, "one_sided_drag": 0.01, "bump": 0.006, "slip_zone": 0.05, "floor_slope_creep": 0.002,
    "collision": 0.015, "turn_speed_loss": 0.02, "clock_rate": 0.002,
    # In no list: steered by the direction, drawn to a point, by turns not long ago, by waves of the floor.
    "out_direction": 0.01, "out_magnet": 0.004, "out_memory": 0.01, "out_waves": 0.012,
}
NOISES = {
    "exact": "none at all, and no counts",
    "clean": "truth of 0.2 mm and 0.2 mrad, wheels without any",
    "coarse": "the same with 360 counts a turn",
    "white": "of each wheel, with the root of its way",
    "share": "of each wheel, a share of each step",
    "slow": "of each wheel, a share that changes within 0.3 s",
    "squares": "truth alone; squares with turns on the spot",
}
STEP_S = 0.002


class Robot:
    def __init__(self, draw, noise):
        self.left_m = draw.uniform(0.04, 0.15)
        self.right_m = self.left_m * (1 + draw.uniform(-0.01, 0.01))
        self.base_m = draw.uniform(0.2, 0.6)
        self.counts = 360 if noise == "coarse" else draw.choice([512, 1024, 2048, 4096, 10000])
        self.whole_counts = noise != "exact" and draw.random() < 0.85
        self.as_ticks = self.whole_counts and draw.random() < 0.5
        self.encoder_hz = draw.choice([50, 100, 200])
        self.truth_hz = draw.choice([10, 20, 50, 100, 120])
        self.late_s = draw.choice([0, 0, 0.02, -0.03])
        self.marker = draw.choice([(0, 0, 0), (0, 0, 0), (0.03, -0.01, 0.02)])
        self.truth_m, self.truth_rad = {"exact": (0, 0), "clean": (2e-4, 2e-4), "coarse": (2e-4, 2e-4)}.get(
            noise, (draw.choice([5e-4, 1e-3, 2e-3]), draw.choice([5e-4, 1e-3, 3e-3])))
        self.wheel_noise = draw.choice([3e-4, 1e-3, 2e-3]) if noise == "white" else 0.0
        self.fastest_mps = draw.uniform(0.3, 1.0)


def legs_of(draw, robot, duration_s, noise):
    """(seconds, speed, yaw rate) one after the other."""
    legs = [(0.5, 0.0, 0.0)]
    if noise == "squares":
        side = draw.choice([-1, 1])
        for _ in range(8):
            legs += [(2.0 / robot.fastest_mps, robot.fastest_mps, 0), (0.6, 0, 0), (math.pi / 1.6, 0, 0.8 * side), (0.6, 0, 0)]
        return legs
    while sum(leg[0] for leg in legs) < duration_s:
        kind, lasts_s = draw.random(), draw.uniform(1.5, 4)
        speed, yaw = robot.fastest_mps * draw.uniform(0.3, 1), draw.choice([-1, 1]) * draw.uniform(0.2, 1.2)
        legs.append((lasts_s, speed, 0) if kind < 0.3 else (lasts_s, speed, yaw) if kind < 0.6 else
                    (lasts_s, 0, 1.3 * yaw) if kind < 0.75 else
                    (lasts_s, -0.7 * speed, draw.choice([0, yaw])) if kind < 0.9 else (0.6, 0, 0))
    return legs


def driven(draw, robot, legs, noise, effect, size, side, left, phase, above_mps, event, start):
    """Rows (time, 'e', left, right) and (time, 't', x, y, heading), and places (x, y, time, speed) for events."""
    x, y, h = start
    v = w = turned_l = turned_r = off_l = off_r = memory = slow_l = slow_r = kick = climbed = 0.0
    direction = leg = 0
    end_s, next_e, next_t, rows, places = legs[0][0], 0.0, 0.0, [], []
    for k in range(int(sum(leg_[0] for leg_ in legs) / STEP_S)):
        t = k * STEP_S
        if t >= next_e - 1e-9:
            rows.append((t, "e", turned_l + off_l, turned_r + off_r))
            next_e += 1.0 / robot.encoder_hz
        if t >= next_t - 1e-9:
            rows.append((t, "t", x, y, h))
            next_t += 1.0 / robot.truth_hz
        if k % 100 == 0:
            places.append((x, y, t, v))
        while t > end_s and leg + 1 < len(legs):
            leg += 1
            end_s += legs[leg][0]
        a = max(-0.8, min(0.8, (legs[leg][1] - v) / 0.1))
        b = max(-2.5, min(2.5, (legs[leg][2] - w) / 0.1))
        v, w = v + a * STEP_S, w + b * STEP_S
        rim_l, rim_r = v - 0.5 * w * robot.base_m, v + 0.5 * w * robot.base_m
        rate_l, rate_r = rim_l / robot.left_m, rim_r / robot.right_m
        turned_l, turned_r = turned_l + rate_l * STEP_S, turned_r + rate_r * STEP_S
        dl, dr, ahead, aside, turn = rim_l * STEP_S, rim_r * STEP_S, 0.0, 0.0, 0.0
        if robot.wheel_noise:
            dl += robot.wheel_noise * math.sqrt(abs(dl)) * draw.gauss(0, 1)
            dr += robot.wheel_noise * math.sqrt(abs(dr)) * draw.gauss(0, 1)
        if noise == "share":
            dl, dr = dl * (1 + 0.03 * draw.gauss(0, 1)), dr * (1 + 0.03 * draw.gauss(0, 1))
        if noise == "slow":
            spread = 0.004 * math.sqrt(2 * STEP_S / 0.3)
            slow_l += -slow_l * STEP_S / 0.3 + spread * draw.gauss(0, 1)
            slow_r += -slow_r * STEP_S / 0.3 + spread * draw.gauss(0, 1)
            dl, dr = dl * (1 + slow_l), dr * (1 + slow_r)
        moves = abs(v) + abs(w) > 0.01
        if effect == "wheel_eccentricity":
            dl *= 1 + (size * math.sin(turned_l + phase) if left else 0)
            dr *= 1 + (0 if left else size * math.sin(turned_r + phase))
        elif effect == "encoder_missed_counts":
            if left and abs(rim_l) > above_mps: off_l -= size * rate_l * STEP_S
            if not left and abs(rim_r) > above_mps: off_r -= size * rate_r * STEP_S
        elif effect == "drivetrain_backlash":  # the encoder runs ahead within the play
            play = lambda off, rate: max(-size / 2, min(size / 2, off + 20 * rate * STEP_S if abs(rate) > 0.01 else off))
            if left: off_l = play(off_l, rate_l)
            else: off_r = play(off_r, rate_r)
        elif effect == "wheel_toe": aside += side * size * v * STEP_S
        elif effect == "castor_reversal_kick":
            now = 1 if v > 0.02 else -1 if v < -0.02 else 0
            if now and direction and now != direction: kick = size
            direction = now or direction
            part = min(kick, size * abs(v) * STEP_S / 0.04)
            kick, turn = kick - part, turn + side * part
        elif effect == "radius_drift":
            dl, dr = (dl * (1 + size * t), dr) if left else (dl, dr * (1 + size * t))
        elif effect == "tyre_compression":
            if v * w > 0: dr -= size * v * w * rate_r * STEP_S
            else: dl += size * v * w * rate_l * STEP_S
        elif effect == "speed_dependent_radius": dl, dr = dl * (1 + size * abs(v)), dr * (1 + size * abs(v))
        elif effect == "payload_radius_change":
            if event and t > event[2]: dl, dr = dl * (1 - size), dr * (1 - 0.6 * size)
        elif effect == "lateral_slip": aside -= size * v * w * STEP_S
        elif effect == "traction_slip":
            dl -= size * (a - 0.5 * b * robot.base_m) * abs(rim_l) * STEP_S
            dr -= size * (a + 0.5 * b * robot.base_m) * abs(rim_r) * STEP_S
        elif effect == "turn_scrub": turn -= size * abs(w) * w * STEP_S
        elif effect == "one_sided_drag": turn += side * size * abs(v) * STEP_S
        elif effect == "bump":
            if event and t > event[2] and climbed < size:
                part = min(size - climbed, 0.2 * abs(dl if left else dr))
                climbed += part
                if left: dl -= math.copysign(part, dl)
                else: dr -= math.copysign(part, dr)
        elif effect == "slip_zone":
            if event:
                sx, sy = -0.5 * robot.base_m * math.sin(h), 0.5 * robot.base_m * math.cos(h)
                if math.hypot(x + sx - event[0], y + sy - event[1]) < event[3]: dl *= 1 - size
                if math.hypot(x - sx - event[0], y - sy - event[1]) < event[3]: dr *= 1 - size
        elif effect == "floor_slope_creep":
            if moves: ahead, aside = size * STEP_S * math.cos(phase - h), size * STEP_S * math.sin(phase - h)
        elif effect == "collision":
            if event and abs(t - event[2]) < 0.075:
                part = STEP_S / 0.15
                ahead, aside = part * size * math.cos(phase), part * size * math.sin(phase)
                turn += part * 1.5 * side * size
        elif effect == "turn_speed_loss":
            dl, dr = dl - size * abs(w) * v * STEP_S, dr - size * abs(w) * v * STEP_S
        elif effect == "out_direction": turn += size * v * STEP_S * math.sin(2 * h)
        elif effect == "out_magnet":
            gx, gy = 0.4 - x, 0.3 - y
            pull = size * STEP_S / (math.hypot(gx, gy) + 0.3) if moves else 0.0
            ahead, aside = pull * (gx * math.cos(h) + gy * math.sin(h)), pull * (gy * math.cos(h) - gx * math.sin(h))
        elif effect == "out_memory":
            memory += w * STEP_S - memory * abs(v) * STEP_S / 0.5
            turn += size * memory * abs(v) * STEP_S
        elif effect == "out_waves": turn += size * abs(v) * STEP_S * math.sin(5 * x + phase)
        turn += (dr - dl) / robot.base_m
        ahead += 0.5 * (dl + dr)
        c, s = math.cos(h + 0.5 * turn), math.sin(h + 0.5 * turn)
        x, y, h = x + ahead * c - aside * s, y + ahead * s + aside * c, h + turn
    return rows, places


def write_case(folder, seed, effect, noise, factor):
    draw = random.Random(f"{seed} {effect} {noise} {factor}")
    robot, size = Robot(draw, noise), SIZES[effect] * factor
    runs, duration_s = draw.choice([3, 4, 6]), draw.choice([40, 60, 80])
    side, left, phase = draw.choice([-1, 1]), draw.random() < 0.5, draw.uniform(0, 2 * math.pi)
    above_mps = draw.uniform(0.25, 0.6) * robot.fastest_mps
    legs = [legs_of(draw, robot, duration_s, noise) for _ in range(runs)]
    starts = [(draw.uniform(-0.5, 0.5), draw.uniform(-0.5, 0.5), draw.uniform(-3, 3)) for _ in range(runs)]
    event, event_run = None, draw.randrange(runs - 1)
    if effect in ("bump", "slip_zone", "collision", "payload_radius_change"):  # on the way of a drive without it
        _, places = driven(random.Random(0), robot, legs[event_run], "", "none", 0, side, left, phase, 0, None, starts[event_run])
        x, y, at_s, _ = draw.choice([p for p in places if abs(p[3]) > 0.15 and 8 < p[2] < places[-1][2] - 8])
        event = (x, y, at_s, draw.uniform(0.25, 0.5))
    for run in range(runs):
        here = event if effect == "slip_zone" or run == event_run else None
        rows, _ = driven(draw, robot, legs[run], noise, effect, size, side, left, phase, above_mps, here, starts[run])
        per_rad, lines = robot.counts / (2 * math.pi), []
        for row in rows:
            if row[1] == "e":
                counts = [math.floor(rad * per_rad) for rad in row[2:4]]
                text = [str(c) if robot.as_ticks else "%.7f" % (c / per_rad) for c in counts] if robot.whole_counts else \
                    [repr(rad) for rad in row[2:4]]
                lines.append((row[0] * (1 + (size if effect == "clock_rate" else 0)), text + ["", "", ""]))
            else:
                x, y, h = row[2:]
                mx, my, mh = robot.marker
                lines.append((row[0] + robot.late_s, ["", ""] + ["%.6f" % value for value in (
                    x + mx * math.cos(h) - my * math.sin(h) + draw.gauss(0, robot.truth_m),
                    y + mx * math.sin(h) + my * math.cos(h) + draw.gauss(0, robot.truth_m),
                    math.remainder(h + mh + draw.gauss(0, robot.truth_rad), 2 * math.pi))]))
        lines.sort(key=lambda line: line[0])
        with open(f"{folder}/run_{run + 1}.csv", "w") as out:
            wheels = "ticks" if robot.as_ticks else "wheel_rad"
            out.write(f"time_s,left_{wheels},right_{wheels},truth_x_m,truth_y_m,truth_heading_rad\n")
            out.writelines("%.6f,%s\n" % (time_s + 0.05, ",".join(cells)) for time_s, cells in lines)
    with open(f"{folder}/vehicle.toml", "w") as out:
        out.write(f'''kind = "differential_drive"
name = "on paper"
[differential_drive]
wheel_radius_left_m = {robot.left_m * (1 + draw.uniform(-0.02, 0.02)):.5f}
wheel_radius_right_m = {robot.right_m * (1 + draw.uniform(-0.02, 0.02)):.5f}
wheelbase_m = {robot.base_m * (1 + draw.uniform(-0.04, 0.04)):.5f}
encoder_counts_per_revolution = {robot.counts}
''')
    return runs


def judged(odolab, seed, effect, noise, factor):
    with tempfile.TemporaryDirectory() as folder:
        runs = write_case(folder, seed, effect, noise, factor)
        files = [f"{folder}/run_{run + 1}.csv" for run in range(runs)]
        done = subprocess.run([odolab, "diagnose", "--vehicle", f"{folder}/vehicle.toml", *files[:-1], "--hold-out", files[-1],
                               "--json", f"{folder}/out.json"], capture_output=True, text=True)
        if not os.path.exists(f"{folder}/out.json"):
            return "BAD", f"exit {done.returncode}: {done.stderr.strip()[:200]}"
        answer = json.load(open(f"{folder}/out.json"))
    # The drawn clock and marker are named by right.
    named = [f["effect"] for f in answer["findings"] if not f["effect"].startswith("truth_")]
    verdict = answer["verdict"]
    quiet = not named and verdict != "unknown_effect"
    ok = quiet if effect == "none" else verdict == "unknown_effect" if effect.startswith("out_") else \
        named == [effect] and verdict != "unknown_effect"
    said = ", ".join(f["effect"] + "".join(" or " + a["effect"] for a in f["alternatives"]) for f in answer["findings"])
    return "OK" if ok else "MISS" if quiet else "BAD", f"{verdict}: {said}"


def main():
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("odolab")
    ask.add_argument("seeds", type=int, nargs="+")
    ask.add_argument("--effects", default=",".join(SIZES))
    ask.add_argument("--noises", default=",".join(NOISES))
    ask.add_argument("--size", type=float, default=1.0)
    given = ask.parse_args()
    cases = [(seed, effect, noise) for seed in given.seeds for effect in given.effects.split(",")
             for noise in given.noises.split(",")]
    counted = {}
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for case, (verdict, said) in zip(cases, pool.map(lambda c: judged(given.odolab, *c, given.size), cases)):
            print(verdict, *case, "->", said, flush=True)
            kind = "nothing missing" if case[1] == "none" else "in no list" if case[1].startswith("out_") else "one effect"
            counted.setdefault((case[2], kind), []).append(verdict)
    for (noise, kind), verdicts in sorted(counted.items()):
        print(f"{noise}, {kind}:", ", ".join(f"{verdicts.count(v)} {v}" for v in ("OK", "MISS", "BAD")))


if __name__ == "__main__":
    main()
