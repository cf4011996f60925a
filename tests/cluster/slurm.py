"""A Slurm of its own on this machine: controller, nodes, munge.

All files are in one folder, all servers listen on the loopback interface, and
each is ended by its process id. Nodes are virtual: several slurmd, with a port
and one processor each, as Debian's build of Slurm allows.
"""

import os
import signal
import socket
import subprocess
import time
from pathlib import Path

CONFIGURATION = """\
ClusterName=lamina
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1
ReturnToService=2
SlurmdTimeout=5
SlurmctldTimeout=5
KillWait=1
NodeName=n[1-{nodes}] NodeHostname={host} NodeAddr=127.0.0.1 \
Port=[{first}-{last}] CPUs=1 RealMemory=1500
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def free_ports(count):
    """`count` ports in a row that nobody listens on."""
    for first in range(17000, 60000, 100):
        try:
            for port in range(first, first + count):
                with socket.socket() as probe:
                    probe.bind(("127.0.0.1", port))
            return first
        except OSError:
            continue
    raise RuntimeError("no ports are free")


def wait_until(holds, seconds, what):
    end = time.monotonic() + seconds
    while not holds():
        if time.monotonic() > end:
            raise RuntimeError(f"waited {seconds} s in vain: {what}")
        time.sleep(0.1)


class Slurm:
    def __init__(self, folder, nodes):
        self.folder = Path(folder)
        self.nodes = [f"n{i}" for i in range(1, nodes + 1)]
        self.servers = {}
        for name in ["state", *self.nodes]:
            (self.folder / name).mkdir(parents=True)
        port = free_ports(nodes + 1)
        self.configuration = self.folder / "slurm.conf"
        self.configuration.write_text(CONFIGURATION.format(
            host=socket.gethostname(), port=port, user="root", nodes=nodes,
            folder=self.folder, first=port + 1, last=port + nodes))
        self.environment = dict(os.environ, SLURM_CONF=str(self.configuration))
        self.environment.pop("SLURM_JOB_ID", None)

    def __enter__(self):
        try:
            key = self.folder / "munge.key"
            key.write_bytes(os.urandom(1024))
            key.chmod(0o400)
            self.start("munged", "--foreground", "--force",
                       f"--key-file={key}",
                       f"--socket={self.folder}/munge.socket",
                       f"--pid-file={self.folder}/munged.pid",
                       f"--log-file={self.folder}/munged.log",
                       f"--seed-file={self.folder}/munged.seed")
            wait_until((self.folder / "munge.socket").exists, 10, "munged")
            self.start_controller()
            for node in self.nodes:
                self.start_node(node)
            wait_until(lambda: self.count_nodes("idle") == len(self.nodes), 30,
                       "nodes that are idle")
            return self
        except BaseException:
            self.__exit__()
            raise

    def __exit__(self, *_):
        # Slurm leaves what keeps watch over a task alone as its node goes.
        self.run("scancel", "--full", "--signal=KILL", "--partition=main",
                 check=False, timeout=10)
        for name in list(self.servers):
            self.kill(name, signal.SIGTERM)
        for process in self.tasks():
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass

    # --- Servers -------------------------------------------------------------

    def start(self, program, *words, name=None):
        log = open(self.folder / f"{name or program}.out", "ab")
        self.servers[name or program] = subprocess.Popen(
            [program, *words], stdin=subprocess.DEVNULL, stdout=log,
            stderr=log, env=self.environment, cwd=self.folder)

    def start_controller(self):
        self.start("slurmctld", "-D")

    def start_node(self, node):
        self.start("slurmd", "-D", "-N", node, name=node)

    def kill(self, name, number=signal.SIGKILL):
        server = self.servers.pop(name)
        server.send_signal(number)
        try:
            server.wait(timeout=10)
        except subprocess.TimeoutExpired:
            server.kill()
            server.wait()

    def processor_seconds(self, name=None):
        """Of all servers so far, or of one."""
        ticks = 0
        for server in self.servers if name is None else [name]:
            process = self.servers[server].pid
            words = Path(f"/proc/{process}/stat").read_text()
            ticks += sum(map(int, words.rsplit(")", 1)[1].split()[11:15]))
        return ticks / os.sysconf("SC_CLK_TCK")

    # --- Jobs ----------------------------------------------------------------

    def run(self, *words, check=True, timeout=60):
        result = subprocess.run(words, capture_output=True, text=True,
                                env=self.environment, timeout=timeout,
                                check=False)
        if check and result.returncode != 0:
            raise RuntimeError(f"{words}: {result.stdout}{result.stderr}")
        return result.stdout

    def count_nodes(self, state):
        names = self.run("sinfo", "-h", "-N", "-o", "%N %T", check=False)
        return sum(line.split()[1] == state for line in names.splitlines())

    def has_jobs(self):
        """True where it is not known, as while there is no controller."""
        result = subprocess.run(["squeue", "-h"], capture_output=True,
                                text=True, env=self.environment, timeout=60,
                                check=False)
        return result.returncode != 0 or bool(result.stdout.strip())

    def wait_for_jobs(self, seconds):
        wait_until(lambda: not self.has_jobs(), seconds, "the end of all jobs")

    def stop_jobs(self):
        """Waits until nothing has run for a while, and ends what still waits:
        for nodes that are down or drained, or for somebody to release it."""
        running = ("squeue", "-h", "--states=RUNNING,COMPLETING,CONFIGURING")
        end = time.monotonic() + 240
        idle_since = time.monotonic()
        while self.has_jobs() and time.monotonic() - idle_since < 8:
            if self.run(*running, check=False).strip():
                idle_since = time.monotonic()
            if time.monotonic() > end:
                raise RuntimeError("jobs run on and on")
            time.sleep(0.2)
        self.run("scancel", "--partition=main")
        self.wait_for_jobs(60)

    def repair_nodes(self):
        for node in self.nodes:
            if node not in self.servers:
                self.start_node(node)
        wait_until(lambda: self.count_nodes("down*") == 0, 60, "all nodes")
        for node in self.nodes:
            self.run("scontrol", "update", f"nodename={node}", "state=resume",
                     check=False)
        wait_until(lambda: self.count_nodes("idle") == len(self.nodes), 60,
                   "nodes that are idle")

    def crash(self, node):
        """Ends a node as a power failure does."""
        self.kill(node)
        for task in self.tasks(node):
            watcher = int(Path(f"/proc/{task}/stat").read_text()
                          .rsplit(")", 1)[1].split()[1])
            for process in (watcher, task):
                os.kill(process, signal.SIGKILL)

    def tasks(self, node=None):
        """Ids of processes that this Slurm has started, of one node or all."""
        found = []
        for entry in Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                variables = (entry / "environ").read_bytes().split(b"\0")
            except OSError:
                continue
            names = dict(v.split(b"=", 1) for v in variables if b"=" in v)
            is_own = (names.get(b"SLURM_CONF") == bytes(self.configuration) and
                      b"SLURM_ARRAY_TASK_ID" in names)
            is_there = (node is None or
                        names.get(b"SLURMD_NODENAME") == node.encode())
            if is_own and is_there:
                found.append(int(entry.name))
        return found
