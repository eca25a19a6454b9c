"""python3 on-terminal.py COLUMNS COMMAND...: runs a command whose standard input, output and error are one terminal of so many columns, prints what the
terminal received, and ends with the command's exit status. SPDX-License-Identifier: GPL-3.0-or-later"""
import fcntl
import os
import pty
import signal
import struct
import sys
import termios

pid, terminal = pty.fork()
if pid == 0:
    signal.signal(signal.SIGPIPE, signal.SIG_DFL)  # Python ignores it, and its children would
    fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("4H", 24, int(sys.argv[1]), 0, 0))
    os.execvp(sys.argv[2], sys.argv[2:])
while True:
    try:
        received = os.read(terminal, 65536)
    except OSError:  # Linux: the other side is closed
        break
    if not received:
        break
    sys.stdout.buffer.write(received)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
