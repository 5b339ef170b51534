#!/usr/bin/env python3
"""Puts parts of pictures next to each other: side_by_side.py [--crop X,Y,W,H] OUT.png IN.png IN.png ...

Needs nothing but Python. Takes what `lightloom render` writes: PNG files of 8 bits in RGB or RGBA, not interlaced.
"""
import argparse
import struct
import zlib

GAP = 4  # pixels of white between two pictures


def unfilter(kind, line, above, step):
    """Undoes a scan line's filter (PNG specification, section 9)."""
    for i in range(len(line)):
        a = line[i - step] if i >= step else 0
        b = above[i]
        c = above[i - step] if i >= step else 0
        if kind == 1:
            guess = a
        elif kind == 2:
            guess = b
        elif kind == 3:
            guess = (a + b) // 2
        elif kind == 4:
            guess = min((abs(b - c), 0, a), (abs(a - c), 1, b), (abs(a + b - 2 * c), 2, c))[2]
        else:
            break
        line[i] = (line[i] + guess) & 255
    return line


def read_png(name):
    """Rows of RGB bytes."""
    with open(name, "rb") as file:
        data = file.read()
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise SystemExit(f"{name}: not a PNG file")
    at, packed, header = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at : at + 8])
        body = data[at + 8 : at + 8 + length]
        if kind == b"IHDR":
            header = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += length + 12
    width, height, depth, colour, _, _, interlace = header
    if depth != 8 or colour not in (2, 6) or interlace:
        raise SystemExit(f"{name}: only RGB and RGBA of 8 bits, not interlaced")
    step = 3 if colour == 2 else 4
    raw, rows, above = zlib.decompress(packed), [], bytearray(width * step)
    for y in range(height):
        start = y * (width * step + 1)
        above = unfilter(raw[start], bytearray(raw[start + 1 : start + 1 + width * step]), above, step)
        rows.append(b"".join(bytes(above[x : x + 3]) for x in range(0, width * step, step)))
    return rows


def write_png(name, rows):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    packed, above = bytearray(), bytes(len(rows[0]))
    for row in rows:  # each as its difference from the row above
        packed += b"\2" + bytes((b - a) & 255 for a, b in zip(above, row))
        above = row
    header = struct.pack(">IIBBBBB", len(rows[0]) // 3, len(rows), 8, 2, 0, 0, 0)
    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(bytes(packed), 9)))
        file.write(chunk(b"IEND", b""))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--crop", help="part of each picture, in pixels")
    parser.add_argument("out")
    parser.add_argument("pictures", nargs="+")
    args = parser.parse_args()
    pictures = [read_png(name) for name in args.pictures]
    if args.crop:
        x, y, width, height = (int(part) for part in args.crop.split(","))
        pictures = [[row[3 * x : 3 * (x + width)] for row in rows[y : y + height]] for rows in pictures]
    if len({len(rows) for rows in pictures}) != 1:
        raise SystemExit("the pictures are of different heights")
    write_png(args.out, [(b"\xff" * 3 * GAP).join(rows) for rows in zip(*pictures)])


if __name__ == "__main__":
    main()
