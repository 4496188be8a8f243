#!/usr/bin/env python3
"""killed_jobs.py TRIPTYCH SOURCES: runs the shards of a plan on scripted devices, as jobs of a real Slurm, and kills a
tenth of the jobs.

Half of the killed jobs are requeued, as if the scheduler needed the node for something else. The other half are killed
together with all their processes, as if the node had failed, and `submit --again` submits them again. At the end, the
merged store must contain every configuration exactly once for each device. With TRIPTYCH_FARM=paper, the test uses
46,656 configurations on three devices.
"""
import contextlib
import os
import pathlib
import random
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time

TRIPTYCH, SOURCES = sys.argv[1], pathlib.Path(sys.argv[2])
CLUSTER = SOURCES / "ci/cluster"
LARGE = os.environ.get("TRIPTYCH_FARM") == "paper"
SHARDS = 200 if LARGE else 30
DEVICES = 3
# Frames are slow enough for the test to catch jobs while they are running.
SCRIPT = '{"devices": [1, 1.7, 0.6], "base_ns": %d, "ns_per_sample": 0, "sleep": true}' % (1e4 if LARGE else 4e7)
PLAN = """suite: volume
technique: [raycast]
data: [generate:gaussian_blob:8, generate:uniform_box:8, generate:gradient_box:8]
transfer_function: [haze]
viewport: [4]
checks: [counters]
"""
SMALL_LEVELS = """step: [0.5, 1]
ert: [0, 0.02]
camera: [{cameras}]
"""
LARGE_LEVELS = """step: [0.25, 0.5, 1, 2]
ert: [0, 0.02]
sampler: [hardware, manual]
shading: [none, gradient]
skip: [none, bricks, distance]
camera: [{cameras}]
"""


def plan_text():
    cameras = ", ".join(f"random:{seed}" for seed in range(162 if LARGE else 20))
    return PLAN + (LARGE_LEVELS if LARGE else SMALL_LEVELS).format(cameras=cameras)


def run(*words, ok=(0,)):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True)
    if done.returncode not in ok:
        sys.exit(f"{' '.join(map(str, words))}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def wait(what, done, seconds):
    end = time.monotonic() + seconds
    while not done():
        if time.monotonic() > end:
            sys.exit(f"after {seconds} s {what} has not happened:\n{run('squeue')}")
        time.sleep(0.1)


def running():
    """Returns the indices of the shards that are being measured, each with the id of its Slurm job."""
    lines = run("squeue", "--noheader", "--array", "--states=RUNNING", "--format=%F %K").splitlines()
    return {int(index): f"{job}_{index}" for job, index in map(str.split, lines) if index.isdigit()}


def records_in(store):
    if not store.exists():
        return 0
    with contextlib.closing(sqlite3.connect(f"file:{store}?mode=ro", uri=True)) as database:
        try:
            return database.execute("SELECT count(*) FROM record").fetchone()[0]
        except sqlite3.OperationalError:  # the tables of the store do not exist yet
            return 0


def kill_some(farm, generator):
    """Kills a tenth of the jobs while they measure. Returns the indices of the jobs that Slurm requeues, and the indices
    of the jobs that are lost."""
    pool = generator.sample(range(1, SHARDS + 1), SHARDS)
    wanted = max(2, SHARDS // 10)
    again, lost = set(), set()
    deadline = time.monotonic() + (3600 if LARGE else 200)
    while len(again) + len(lost) < wanted:
        targets = [index for index in pool if index not in again | lost][:wanted - len(again) - len(lost)]
        jobs = running()
        for index in targets:
            if (farm / "1" / f"shard-{index}.ended").exists():
                pool.remove(index)  # this job has already ended, so another job is killed instead
            elif index in jobs and records_in(farm / "1" / f"shard-{index}.sqlite") > index % 5:
                how, killed = (("scontrol", "requeue"), again) if len(again) <= len(lost) else (
                    ("scancel", "--signal=KILL", "--full"), lost)
                if subprocess.run([*how, jobs[index]], capture_output=True).returncode == 0:
                    killed.add(index)
        if time.monotonic() > deadline:
            sys.exit(f"shards {targets} have not been seen running:\n{run('squeue')}")
        time.sleep(0.02)
    return again, lost


def not_ended(farm):
    return {index for index in range(1, SHARDS + 1) if not (farm / "1" / f"shard-{index}.ended").exists()}


def queue_is_empty():
    return not run("squeue", "--noheader", "--states=PENDING,RUNNING,COMPLETING,CONFIGURING")


def check_merged(store, configurations):
    with contextlib.closing(sqlite3.connect(store)) as database:
        found = database.execute("SELECT configuration, device, outcome, reason FROM record").fetchall()
        runs = database.execute("SELECT configurations FROM run").fetchall()
    devices = {device for _, device, _, _ in found}
    assert len(devices) == DEVICES, devices
    assert runs == [(len(configurations),)], runs
    assert len(found) == DEVICES * len(configurations), f"{len(found)} records"
    assert {(key, device) for key, device, _, _ in found} == {(key, device) for key in configurations for device in devices}
    others = [record for record in found if record[2] != "measured"]
    assert not others, others[:3]


def check_sizes(folder, plan, store, configurations):
    """Submits jobs that should take about a minute each, based on the times of an earlier run, and cancels them."""
    with contextlib.closing(sqlite3.connect(store)) as database:
        count, seconds = database.execute(
            "SELECT count(*), total(prepare_ns + overhead_ns + loop_wall_ns) / 1e9 FROM record").fetchone()
        seconds += database.execute("SELECT total(ns) / 1e9 FROM sample WHERE clock = 'wall'").fetchone()[0]
    assert count == DEVICES * configurations
    told = run(CLUSTER / "submit", "--folder", folder / "sized", "--minutes", 1, "--like", store, "--device", "null:*", plan)
    wanted = -(-seconds // 60)
    assert f"of {wanted:.0f} were submitted as job" in told, f"{seconds} s: {told}"
    run("scancel", "--user", os.environ.get("USER", "root"))
    wait("the end of what was cancelled", queue_is_empty, 300)


def test(folder, generator):
    plan = folder / "plan.yaml"
    plan.write_text(plan_text())
    configurations = {line.split()[-1] for line in run(TRIPTYCH, "list", plan).splitlines()}
    farm = folder / "farm"
    begin = time.monotonic()
    run(CLUSTER / "submit", "--folder", farm, "--shards", SHARDS, "--device", "null:*", plan)
    sent_again, killed = kill_some(farm, generator)
    wait("the end of all jobs", queue_is_empty, 6000 if LARGE else 300)
    told = (farm / "merge.log").read_text()
    lost = not_ended(farm)
    assert lost and lost <= killed, f"{lost} did not end, {killed} were killed; {told}"
    assert not (farm / "merged.sqlite").exists(), told
    assert f"shards {ranges(lost)} of {SHARDS} are not complete" in told and f"submit --again {farm}" in told, told
    for index in sent_again:
        log = (farm / "1" / f"shard-{index}.log").read_text()
        assert "attempt 2 of job" in log and "were already in the store" in log, log
    assert f"shards {ranges(lost)} of" in run(CLUSTER / "submit", "--again", farm)
    wait("the end of what was sent again", queue_is_empty, 600)
    told = (farm / "merge.log").read_text()
    assert (farm / "merged.sqlite").exists(), told
    check_merged(farm / "merged.sqlite", configurations)
    check_sizes(folder, plan, farm / "merged.sqlite", len(configurations))
    run(TRIPTYCH, "report", "--store", farm / "merged.sqlite", "--out", folder / "report.html") if not LARGE else None
    print(f"{len(configurations)} configurations on {DEVICES} devices in {SHARDS} jobs, {len(lost)} killed for good and "
          f"{len(sent_again)} sent again by Slurm: all there once, {time.monotonic() - begin:.0f} s")


def ranges(indices):
    """Formats indices as ci/cluster does, for example as 1-3,7."""
    parts, numbers = [], sorted(indices)
    while numbers:
        end = 1
        while end < len(numbers) and numbers[end] == numbers[0] + end:
            end += 1
        parts.append(str(numbers[0]) if end == 1 else f"{numbers[0]}-{numbers[end - 1]}")
        numbers = numbers[end:]
    return ",".join(parts)


def main():
    missing = [each for each in ("slurmctld", "slurmd", "sbatch") if not shutil.which(each, path=os.environ["PATH"] + ":/usr/sbin")]
    if missing:
        print(f"skipped: there is no {missing[0]}; ci/setup --cluster installs Slurm")
        sys.exit(77)
    os.environ.update(TRIPTYCH_NULL_SCRIPT=SCRIPT, TRIPTYCH_DATA="", TRIPTYCH=TRIPTYCH)
    with tempfile.TemporaryDirectory(prefix="triptych-farm-") as name:
        slurm = pathlib.Path(name) / "slurm"
        said = run(CLUSTER / "local", "up", slurm, "--nodes", 4)
        os.environ["SLURM_CONF"] = said.strip().partition("=")[2]
        try:
            test(pathlib.Path(name), random.Random(31))
        finally:
            run(CLUSTER / "local", "down", slurm)


if __name__ == "__main__":
    main()
