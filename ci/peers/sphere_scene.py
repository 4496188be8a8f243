"""Code shared by the comparisons with spheres: random spheres, a file that contains them, and their image in double
precision."""
import struct

import numpy

import peer

EDGE = 1024
AMBIENT, DIFFUSE = 0.3, 0.7


class Spheres:
    """Random spheres in a cube with an edge length of 10. Their radius depends on their number, so that their total volume is
    the same for any number."""

    def __init__(self, count):
        random = numpy.random.default_rng(count)
        self.centres = (random.random((count, 3)) * 10).astype(numpy.float32)
        self.radius = numpy.float32(0.3 * 10 / count ** (1 / 3))
        self.colours = random.integers(30, 256, (count, 3)).astype(numpy.uint8)

    def write(self, file):
        """Writes a MegaMol file with one list, which has one radius, positions as floats and colours as bytes."""
        count = len(self.centres)
        rows = numpy.zeros(count, dtype=[("place", "<f4", 3), ("colour", "u1", 3)])
        rows["place"], rows["colour"] = self.centres, self.colours
        box = [0.0, 0.0, 0.0, 10.0, 10.0, 10.0]
        vertices, colours = 1, 1  # x, y, z as floats; r, g, b as bytes
        head = struct.pack("<6sHI12f", b"MMPLD\0", 100, 1, *box, *box)
        body = struct.pack("<IBBfQ", 1, vertices, colours, self.radius, count) + rows.tobytes()
        begin = len(head) + 16  # the offsets of the first frame and of the end of the file come first
        file.write_bytes(head + struct.pack("<2Q", begin, begin + len(body)) + body)

    def image(self, frame):
        """Returns the reference image in premultiplied RGBA, top row first. Tests all pixels in the square around each
        silhouette."""
        rays = peer.pixel_rays(frame, EDGE)
        rays /= numpy.linalg.norm(rays, axis=2, keepdims=True)
        view = frame["camera"]
        forward, up = numpy.array(view["forward"]), numpy.array(view["up"])
        centres = self.centres.astype(float) - numpy.array(view["eye"])
        radius, depth = float(self.radius), centres @ forward
        focal = EDGE / 2 / numpy.tan(numpy.radians(view["fov_y_deg"]) / 2)
        column = EDGE / 2 + focal * (centres @ numpy.cross(forward, up)) / depth
        row = EDGE / 2 - focal * (centres @ up) / depth
        reach = int(numpy.ceil(1.5 * focal * radius / (depth.min() - radius))) + 1
        nearest, shown = numpy.full((EDGE, EDGE), numpy.inf), numpy.zeros((EDGE, EDGE, 4))
        for dy in range(-reach, reach + 1):
            for dx in range(-reach, reach + 1):
                x, y = column.astype(int) + dx, row.astype(int) + dy
                some = numpy.flatnonzero((x >= 0) & (x < EDGE) & (y >= 0) & (y < EDGE))
                ray, centre = rays[y[some], x[some]], centres[some]
                along = (ray * centre).sum(axis=1)
                half = radius**2 - ((centre - along[:, None] * ray) ** 2).sum(axis=1)
                some, along, half = some[half > 0], along[half > 0], numpy.sqrt(half[half > 0])
                order = numpy.argsort(half - along, kind="stable")  # so that the nearest sphere in a pixel is written last
                some, entry, half = some[order], (along - half)[order], half[order]
                front = entry < nearest[y[some], x[some]]
                some, entry, half = some[front], entry[front], half[front]
                nearest[y[some], x[some]] = entry
                shade = AMBIENT + DIFFUSE * half / radius
                shown[y[some], x[some], :3] = self.colours[some] / 255 * shade[:, None]
                shown[y[some], x[some], 3] = 1
        return shown
