"""A private Slurm cluster for a test: one node, which is this machine, stopped after the test."""

import getpass
import os
import pathlib
import shutil
import socket
import subprocess
import time

PATIENCE = 600  # s; a loaded machine may be slow.
MISSING = [name for name in ("slurmctld", "slurmd", "sbatch") if not shutil.which(name)]

CONFIGURATION = """ClusterName=test
SlurmctldHost=localhost
SlurmUser={user}
SlurmdUser={user}
SlurmctldPort={control_port}
SlurmdPort={node_port}
AuthType=auth/none
CredType=cred/none
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,bf_interval=1,sched_interval=1
MpiDefault=none
NodeName=localhost CPUs={processors} RealMemory=4096 State=UNKNOWN
PartitionName=main Nodes=localhost Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    sockets = [socket.create_server(("", 0)) for _ in range(count)]
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


class CannotStart(Exception):
    """Slurm cannot start; the text says why."""


class Slurm:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        control_port, node_port = free_ports(2)
        configuration = self.folder / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(
            user=getpass.getuser(), folder=self.folder, control_port=control_port, node_port=node_port,
            processors=max(2, os.cpu_count() or 1)))
        self.environment = {**os.environ, "SLURM_CONF": str(configuration)}
        self.processes = []
        for program in (["slurmctld", "-D"], ["slurmd", "-D", "-N", "localhost"]):
            with open(self.folder / f"{program[0]}.log", "w") as log:
                self.processes.append(subprocess.Popen(program, env=self.environment, stdout=log,
                                                       stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL))
        try:
            self.wait_for(lambda: "idle" in self.run("sinfo", "--noheader", "--format=%T", check=False))
        except RuntimeError as error:
            self.stop()
            raise CannotStart(str(error).splitlines()[-1]) from error

    def run(self, *command, check=True, **environment):
        result = subprocess.run([str(part) for part in command], env={**self.environment, **environment},
                                capture_output=True, text=True, timeout=PATIENCE)
        if check and result.returncode != 0:
            raise RuntimeError(f"{command}: {result.stderr}")
        return result.stdout.strip()

    def wait_for(self, condition):
        end = time.monotonic() + PATIENCE
        while not condition():
            if time.monotonic() > end or any(process.poll() is not None for process in self.processes):
                raise RuntimeError("\n".join(path.read_text() for path in self.folder.glob("slurm*.log")))
            time.sleep(0.2)

    def wait_for_jobs(self):
        """Returns the final states of the jobs by name."""
        self.wait_for(lambda: not self.run("squeue", "--noheader"))
        jobs = self.run("scontrol", "show", "job", "--oneliner").splitlines()
        fields = [dict(part.split("=", 1) for part in job.split() if "=" in part) for job in jobs]
        return {name: {job["JobState"] for job in fields if job["JobName"] == name}
                for name in {job["JobName"] for job in fields}}

    def stop(self):
        for process in reversed(self.processes):
            process.terminate()
            process.wait(PATIENCE)
