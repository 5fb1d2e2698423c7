"""Corpora as text: an input a line, with \\xNN for what is no printable ASCII and for the backslash."""

from pathlib import Path


def escaped(data):
    return "".join(chr(b) if 0x20 <= b < 0x7F and b != 0x5C else f"\\x{b:02x}" for b in data)


def unescaped(line):
    data, i = bytearray(), 0
    while i < len(line):
        if line[i] == "\\" and i + 3 < len(line):
            data.append(int(line[i + 2:i + 4], 16))
            i += 4
        else:
            data.append(ord(line[i]))
            i += 1
    return bytes(data)


def unpack(corpus, folder):
    """Files for libFuzzer."""
    for i, line in enumerate(Path(corpus).read_text(encoding="ascii").split("\n")[:-1]):
        (Path(folder) / f"{i:05}").write_bytes(unescaped(line))


def pack(folder, corpus):
    lines = sorted({escaped(path.read_bytes()) for path in Path(folder).iterdir()}, key=lambda line: (len(line), line))
    Path(corpus).write_text("".join(line + "\n" for line in lines), encoding="ascii")
