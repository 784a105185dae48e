"""A film as an animated PNG: few colours, and of each picture only what is not as in the one before. Python 3 alone."""
import struct
import zlib

import smaller_png
from smaller_png import chunk, palette_for, rows_of

COLORS = 64
OLD = 0  # the number of the colour that lets the picture before through


def pixels_of(path, part):
    left, top, right, bottom = part
    with open(path, "rb") as file:
        rows, channels, _ = rows_of(file.read())
    return [list(zip(row[0::channels], row[1::channels], row[2::channels]))[left:right] for row in rows[top:bottom]]


def numbered(films):
    """Every picture in numbers of one palette, from 1 on."""
    counts = {}
    for rows in films:
        for row in rows:
            for color in row:
                counts[color] = counts.get(color, 0) + 1
    smaller_png.COLORS = COLORS
    palette, number_of = palette_for(counts)
    return palette, [[[number_of[color] + 1 for color in row] for row in rows] for rows in films]


def changed(before, now):
    """The smallest part that holds all that is new: left, top, its rows; what is not new is OLD."""
    new = [(x, y) for y, (a, b) in enumerate(zip(before, now)) for x, (p, q) in enumerate(zip(a, b)) if p != q]
    xs, ys = [x for x, _ in new] or [0], [y for _, y in new] or [0]
    left, top, right, bottom = min(xs), min(ys), max(xs) + 1, max(ys) + 1
    return left, top, [[q if q != p else OLD for p, q in zip(a[left:right], b[left:right])]
                       for a, b in zip(before[top:bottom], now[top:bottom])]


def packed(rows):
    return zlib.compress(b"".join(b"\0" + bytes(row) for row in rows), 9)


def write_film(paths, part, to, seconds_each, most_bytes):
    """Shown again and again; fails where it does not become small enough."""
    palette, films = numbered([pixels_of(path, part) for path in paths])
    width, height = len(films[0][0]), len(films[0])
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0))
    data += chunk(b"acTL", struct.pack(">II", len(films), 0))
    data += chunk(b"PLTE", b"\0\0\0" + b"".join(bytes(color) for color in palette)) + chunk(b"tRNS", b"\0")
    sequence = 0
    for i, film in enumerate(films):
        left, top, rows = changed(films[i - 1], film) if i else (0, 0, film)
        # What is drawn stays, and the next is drawn over it.
        control = struct.pack(">IIIIIHHBB", sequence, len(rows[0]), len(rows), left, top, round(1000 * seconds_each), 1000,
                              0, 1 if i else 0)
        data += chunk(b"fcTL", control)
        sequence += 1
        if i:
            data += chunk(b"fdAT", struct.pack(">I", sequence) + packed(rows))
            sequence += 1
        else:
            data += chunk(b"IDAT", packed(rows))
    data += chunk(b"IEND", b"")
    if len(data) > most_bytes:
        raise SystemExit(f"{to} takes {len(data)} bytes, more than {most_bytes}")
    with open(to, "wb") as file:
        file.write(data)
