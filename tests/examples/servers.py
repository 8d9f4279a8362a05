"""choreods of a test's own, with certificates of its own."""

import os
import pathlib
import signal
import subprocess
import tempfile


class Server:
    """A choreod of $CHOREOD, which ends with the context, if not before. `more`: of its environment."""

    def __init__(self, *flags, **more):
        command = [os.environ["CHOREOD"], "--listen", "127.0.0.1:0", *map(str, flags)]
        self._log = tempfile.TemporaryFile("w+")
        self._process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=self._log, text=True, env=os.environ | more)

    def __enter__(self):
        for line in self._process.stdout:
            if "listens on " in line:
                self.address = line.split()[-1]
                return self
        self.__exit__()
        raise RuntimeError("choreod ended before it served")

    def __exit__(self, *_):
        self.kill()
        self._process.wait()
        self._process.stdout.close()
        self._log.close()

    def log(self):
        self._log.seek(0)
        return self._log.read()

    def drain(self):
        self._process.send_signal(signal.SIGTERM)

    def kill(self):
        self._process.send_signal(signal.SIGKILL)


class Authority:
    """Signs certificates that are good for a day; all files stand in a folder."""

    def __init__(self, folder):
        self._folder = pathlib.Path(folder)
        self.certificate, self.key = self._make("authority")

    def issue(self, name, names):
        """(certificate, key) for `names`, as in "DNS:localhost"."""
        extensions = ["-addext", f"subjectAltName={names}", "-addext", "basicConstraints=CA:FALSE"]
        return self._make(name, "-CA", self.certificate, "-CAkey", self.key, *extensions)

    def _make(self, name, *more):
        certificate, key = self._folder / f"{name}.pem", self._folder / f"{name}.key"
        fresh = ["-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-noenc", "-days", "1", "-keyout", key, "-out", certificate]
        subprocess.run(["openssl", "req", "-x509", "-subj", f"/CN={name}", *fresh, *more], check=True, capture_output=True)
        return certificate, key
