"""Makes a screenshot smaller: 256 colours, chosen by median cut. Python 3 alone."""
import struct
import zlib

COLORS = 256


def chunks(data):
    at = 8
    while at < len(data):
        size, = struct.unpack_from(">I", data, at)
        yield data[at + 4:at + 8], data[at + 8:at + 8 + size]
        at += 12 + size


def paeth(a, b, c):
    p = a + b - c
    pa, pb, pc = abs(p - a), abs(p - b), abs(p - c)
    return a if pa <= pb and pa <= pc else b if pb <= pc else c


def rows_of(data):
    """The rows of an 8-bit RGB or RGBA image, and its channels."""
    head, packed = b"", b""
    for kind, content in chunks(data):
        if kind == b"IHDR":
            head = content
        elif kind == b"IDAT":
            packed += content
    width, height, depth, kind = struct.unpack_from(">IIBB", head)
    assert depth == 8 and kind in (2, 6)
    channels = 3 if kind == 2 else 4
    raw, stride = zlib.decompress(packed), width * channels
    before, rows = bytearray(stride), []
    for y in range(height):
        at = y * (stride + 1)
        how, row = raw[at], bytearray(raw[at + 1:at + 1 + stride])
        if how == 2:
            row = bytearray((x + b) & 255 for x, b in zip(row, before))
        elif how:
            for i in range(stride):
                a = row[i - channels] if i >= channels else 0
                c = before[i - channels] if i >= channels else 0
                guess = a if how == 1 else (a + before[i]) // 2 if how == 3 else paeth(a, before[i], c)
                row[i] = (row[i] + guess) & 255
        rows.append(row)
        before = row
    return rows, channels, width


def palette_for(counts):
    """The middles of boxes of colours, each split where its longest side has half its pixels."""
    boxes = [list(counts.items())]
    while len(boxes) < COLORS:
        def weight(box):
            spans = [max(c[i] for c, _ in box) - min(c[i] for c, _ in box) for i in range(3)]
            return max(spans) * sum(n for _, n in box) ** 0.4
        boxes.sort(key=weight)
        box = boxes.pop()
        if len(box) < 2:
            boxes.append(box)
            break
        spans = [max(c[i] for c, _ in box) - min(c[i] for c, _ in box) for i in range(3)]
        side = spans.index(max(spans))
        box.sort(key=lambda entry: (entry[0][side], entry[0]))
        half, passed, cut = sum(n for _, n in box) / 2, 0, 1
        for cut, (_, n) in enumerate(box[:-1], 1):
            passed += n
            if passed >= half:
                break
        boxes += [box[:cut], box[cut:]]
    palette, index_of = [], {}
    for box in boxes:
        total = sum(n for _, n in box)
        palette.append(tuple(round(sum(c[i] * n for c, n in box) / total) for i in range(3)))
        for color, _ in box:
            index_of[color] = len(palette) - 1
    return palette, index_of


def chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


def shrink(path, most_bytes, to=None, part=None):
    """Rewrites the file, or writes `part` of it (left, top, right, bottom) as `to`; fails where that
    does not make it small enough."""
    with open(path, "rb") as file:
        rows, channels, width = rows_of(file.read())
    left, top, right, bottom = part or (0, 0, width, len(rows))
    pixels = [list(zip(row[0::channels], row[1::channels], row[2::channels]))[left:right]
              for row in rows[top:bottom]]
    width, path = right - left, to or path
    counts = {}
    for row in pixels:
        for color in row:
            counts[color] = counts.get(color, 0) + 1
    palette, index_of = palette_for(counts)
    raw = b"".join(b"\0" + bytes(index_of[color] for color in row) for row in pixels)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, len(pixels), 8, 3, 0, 0, 0))
    data += chunk(b"PLTE", b"".join(bytes(color) for color in palette))
    data += chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b"")
    if len(data) > most_bytes:
        raise SystemExit(f"{path} takes {len(data)} bytes, more than {most_bytes}")
    with open(path, "wb") as file:
        file.write(data)
