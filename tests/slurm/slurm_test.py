#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A sweep as a job array of Slurm gives the table of a sweep on this machine, also if a task is lost.

    slurm_test.py RAVE EXPERIMENT

Starts munged, slurmctld and slurmd with files of their own, and ends them. Needs root, as slurmd
does. Exit code 77: something is not installed.
"""
import os
import pathlib
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scancel", "sinfo")
PATIENCE_S = 60


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Cluster:
    """One node of two processors."""

    def __init__(self, folder):
        self.folder = folder
        self.processes = []
        key = folder / "munge.key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o400)
        # munged refuses a socket that others cannot reach.
        folder.chmod(0o755)
        controller, node = free_ports(2)
        name = socket.gethostname()
        for part in ("state", "spool"):
            (folder / part).mkdir()
        (folder / "slurm.conf").write_text(f"""\
ClusterName=test
SlurmctldHost={name}(127.0.0.1)
SlurmUser=root
SlurmctldPort={controller}
SlurmdPort={node}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CryptoType=crypto/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_res
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
MpiDefault=none
NodeName={name} NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes={name} Default=YES MaxTime=INFINITE State=UP
""")
        self.environment = dict(os.environ, SLURM_CONF=str(folder / "slurm.conf"))

    def start(self):
        folder = self.folder
        self.run("munged", "--foreground", "--force", f"--key-file={folder}/munge.key",
                 f"--socket={folder}/munge.socket", f"--pid-file={folder}/munged.pid",
                 f"--log-file={folder}/munged.log", f"--seed-file={folder}/munge.seed")
        self.wait(lambda: (folder / "munge.socket").exists(), "munged")
        self.run("slurmctld", "-D", "-c", "-f", str(folder / "slurm.conf"))
        self.run("slurmd", "-D", "-f", str(folder / "slurm.conf"))
        self.wait(lambda: "idle" in self.ask("sinfo", "-h", "-o", "%T"), "a node that is idle")

    def run(self, *words):
        with open(self.folder / f"{words[0]}.out", "w", encoding="utf-8") as out:
            self.processes.append(subprocess.Popen(words, stdout=out, stderr=out, env=self.environment,
                                                   start_new_session=True))

    def ask(self, *words):
        return subprocess.run(words, capture_output=True, text=True, env=self.environment, check=False).stdout

    def wait(self, holds, what):
        end = time.monotonic() + PATIENCE_S
        while not holds():
            if time.monotonic() > end:
                logs = "\n".join(f"{log}:\n{log.read_text(errors='replace')[-2000:]}"
                                 for log in self.folder.glob("*.[lo][ou][gt]"))
                sys.exit(f"never {what}\n{logs}")
            time.sleep(0.1)

    def end(self):
        for process in reversed(self.processes):
            process.terminate()
            try:
                process.wait(15)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()


def kill_a_task(folder):
    """Ends one of the tasks as a lost node would: without a word. True once there was one."""
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if b"--shard" in words and str(folder).encode() in words:
            os.kill(int(entry.name), signal.SIGKILL)
            return True
    return False


def sweep(rave, experiment, output, *words, **more):
    return subprocess.Popen([rave, "sweep", experiment, "--output", str(output), *words],
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)


def check(process, code, said):
    out, _ = process.communicate(timeout=300)
    if process.returncode != code or said not in out:
        sys.exit(f"exit code {process.returncode}, expected {code} and `{said}`:\n{out}")


def main():
    rave, experiment = sys.argv[1:3]
    os.environ["PATH"] += ":/usr/sbin:/sbin"
    missing = [program for program in PROGRAMS if shutil.which(program) is None]
    if missing or os.geteuid() != 0:
        print(f"skipped: {', '.join(missing) or 'root'} is missing")
        return 77
    with tempfile.TemporaryDirectory(prefix="rave-slurm-") as name:
        folder = pathlib.Path(name)
        check(sweep(rave, experiment, folder / "here"), 0, "28 runs, 28 of them now")
        check(sweep(rave, experiment, folder / "none", "--slurm", "2", env={"PATH": "/nowhere"}), 2,
              "there is no `sbatch` in PATH")
        (folder / "slurm").mkdir()
        cluster = Cluster(folder / "slurm")
        try:
            cluster.start()
            there = folder / "there"
            check(sweep(rave, experiment, there, "--slurm", "2", env=cluster.environment), 0,
                  "28 runs, 28 of them now")
            lossy = folder / "lossy"
            process = sweep(rave, experiment, lossy, "--slurm", "3", env=cluster.environment)
            cluster.wait(lambda: kill_a_task(lossy), "a task to kill")
            check(process, 0, "28 runs, 28 of them now")
            check(sweep(rave, experiment, folder / "wrong", "--slurm", "2",
                        "--slurm-option=--partition=nowhere", env=cluster.environment), 2,
                  "Slurm refuses the job: sbatch: error: ")
        finally:
            cluster.end()
        table = (folder / "here/runs.csv").read_bytes()
        for other in ("there", "lossy"):
            if (folder / other / "runs.csv").read_bytes() != table:
                sys.exit(f"the table of `{other}` differs")
    print("ok")
    return 0


if __name__ == "__main__":
    sys.exit(main())
