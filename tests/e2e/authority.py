"""Makes certificates for tests with openssl."""

import pathlib
import subprocess

NEW_KEY = ("-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1", "-nodes")


def openssl(*arguments):
    subprocess.run(["openssl", *map(str, arguments)], check=True, capture_output=True)


def validity(days):
    """OpenSSL 3.5 takes no negative days, and 3.0 no dates."""
    version = subprocess.run(("openssl", "version"), check=True, capture_output=True, text=True).stdout.split()[1]
    if days > 0 or tuple(map(int, version.split(".")[:2])) < (3, 4):
        return "-days", days
    return "-not_before", "20200101000000Z", "-not_after", "20200102000000Z"


class Authority:
    """A certificate authority for servers and clients, with its own folder."""

    def __init__(self, folder, name):
        self.folder = pathlib.Path(folder, name)
        self.folder.mkdir()
        self.certificate = self.folder / "ca.pem"
        openssl("req", "-x509", *NEW_KEY, "-days", 2, "-subj", f"/CN={name}",
                "-addext", "keyUsage=critical,keyCertSign,cRLSign",
                "-keyout", self.folder / "ca.key", "-out", self.certificate)

    def issue(self, name, days=1, hosts="DNS:localhost,IP:127.0.0.1"):
        """The files of a certificate for `hosts` and of its key. With negative `days` it has already expired."""
        request, key, certificate = (self.folder / (name + suffix) for suffix in (".csr", ".key", ".pem"))
        openssl("req", *NEW_KEY, "-subj", f"/CN={name}", "-addext", f"subjectAltName={hosts}",
                "-keyout", key, "-out", request)
        openssl("x509", "-req", "-in", request, "-CA", self.certificate, "-CAkey", self.folder / "ca.key",
                "-copy_extensions", "copy", *validity(days), "-out", certificate)
        return certificate, key
