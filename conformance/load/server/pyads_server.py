"""The test server of pyads with one variable, at a port that the system picks, until stdin ends.

    pyads_server.py GROUP OFFSET VALUE-IN-HEX
"""

import platform
import socket
import sys
import time
from importlib.metadata import version

from pyads import constants
from pyads.testserver import AdsTestServer, AdvancedHandler
from pyads.testserver.advanced_handler import PLCVariable

group, offset, value = int(sys.argv[1]), int(sys.argv[2]), bytes.fromhex(sys.argv[3])
handler = AdvancedHandler()
handler.add_variable(
    PLCVariable("value", value, constants.ADST_UINT32, "DWORD", index_group=group, index_offset=offset)
)
server = AdsTestServer(handler=handler, ip_address="127.0.0.1", port=0)
port = server.server.getsockname()[1]
server.start()

# The thread needs some time before it listens.
until = time.monotonic() + 20
while True:
    try:
        socket.create_connection(("127.0.0.1", port)).close()
        break
    except ConnectionRefusedError:
        if time.monotonic() > until:
            raise
        time.sleep(0.01)

print(f"listening on 127.0.0.1:{port}, {version('pyads')} on Python {platform.python_version()}", flush=True)
sys.stdin.read()
