#!/usr/bin/env python3
"""How far metal in an environment is from the integral of its lobe, by how much light the lobe is taken to mirror and where its
middle is taken to lie.

usage: rough_metal.py ENVIRONMENT.hdr [fit]     needs NumPy

Prints a table by roughness: the mean absolute difference on a ball seen from afar, as a share of the mean, numbers clipped
at 4. The integral is of reflectedRadiance (renderer/shaders/shared/brdf.h), with the light between microfacets added to its lobe
(Turquin, "Practical Multiple Scattering Compensation for Microfacet Models", 2019). With `fit`, prints the polynomials of
sharesOfLobe (renderer/shaders/shared/reflected_around.h) instead, fitted to its integrals.
"""

import sys
from pathlib import Path

import numpy as np

COLOR = np.array([0.9, 0.7, 0.4])
HEIGHT, WIDTH = 64, 128  # of the environment, as it is summed up
POINTS = 200
BRIGHTEST = 4.0
EYE = np.array([0.0, 0, 1])
ROUGHNESS = (0.3, 0.5, 0.7, 0.85, 1.0)
# Powers of alpha and of the cosine: of quotients' numerators and denominators, whose constant is 1.
MIRRORED = ([(0, 0), (0, 1), (0, 2), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)], [(0, 2), (1, 0), (1, 2), (2, 0), (2, 1), (2, 2)])
GRAZING = ([(0, 0), (0, 1), (0, 2), (1, 0)], [(0, 1), (0, 2), (1, 0), (1, 1), (2, 0), (2, 1)])


def unit(vectors):
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def rgbe(path):
    """Radiance of a picture whose lines are run-length encoded, as all new ones are."""
    content = path.read_bytes()
    head = content.index(b"\n\n") + 2
    place = content.index(b"\n", head) + 1
    _, height, _, width = content[head:place].split()
    texels = np.zeros((int(height), int(width), 4), np.uint8)
    for row in texels:
        place += 4
        for channel in range(4):
            at = 0
            while at < len(row):
                count, place = content[place], place + 1
                if count > 128:
                    count -= 128
                    row[at:at + count, channel] = content[place]
                    place += 1
                else:
                    row[at:at + count, channel] = np.frombuffer(content[place:place + count], np.uint8)
                    place += count
                at += count
    exponent = texels[..., 3].astype(float)
    return texels[..., :3] * np.where(exponent > 0, 2.0 ** (exponent - 136), 0)[..., None]


def directions():
    elevation = np.pi * (0.5 - (np.arange(HEIGHT) + 0.5) / HEIGHT)[:, None]
    azimuth = 2 * np.pi * ((np.arange(WIDTH) + 0.5) / WIDTH - 0.5)[None]
    towards = np.stack([np.cos(elevation) * np.cos(azimuth), np.sin(elevation) + 0 * azimuth,
                        np.cos(elevation) * np.sin(azimuth)], -1).reshape(-1, 3)
    solid = np.repeat(np.cos(elevation), WIDTH, 1).reshape(-1)
    return towards, solid * (4 * np.pi / solid.sum())


def points():
    """Normals of a ball, spread as its pixels are."""
    n = np.arange(POINTS)
    radius, turn = 0.97 * np.sqrt((n + 0.5) / POINTS), n * np.pi * (3 - np.sqrt(5))
    return np.stack([radius * np.cos(turn), radius * np.sin(turn), np.sqrt(1 - radius ** 2)], -1)


def lobe(normals, towards, alpha):
    """Distribution times masking times cosine, and Schlick's share, of each normal and direction."""
    half = unit(towards + EYE)
    nl, nv = np.clip(normals @ towards.T, 0, 1), (normals @ EYE)[:, None]
    nh, vh, a2 = np.clip(normals @ half.T, 0, 1), np.clip(half @ EYE, 0, 1), alpha * alpha
    distribution = a2 / (np.pi * (nh * nh * (a2 - 1) + 1) ** 2)
    masking = 0.5 / (nl * np.sqrt(nv * nv * (1 - a2) + a2) + nv * np.sqrt(nl * nl * (1 - a2) + a2) + 1e-9)
    return distribution * masking * nl, (1 - vh) ** 5


def around(axes, towards, solid, light, alpha):
    """Mean radiance over lobes seen along their axes, as the levels of an environment hold it."""
    found = []
    for axis in axes:
        cosine = np.clip(towards @ axis, 0, 1)
        weight = solid * cosine / ((1 + cosine) / 2 * (alpha * alpha - 1) + 1) ** 2
        found.append(weight @ light / weight.sum())
    return np.array(found)


def karis(roughness, nv):
    rest, bias = 1 - roughness, 0.0425 - 0.0275 * roughness
    a004 = np.minimum(rest * rest, np.exp2(-9.28 * nv)) * rest + bias
    return 1.04 - 0.572 * roughness - 1.04 * a004, 1.04 * a004 + 0.022 * roughness - 0.04


def share_off(exact, shown):
    exact, shown = np.clip(exact, 0, BRIGHTEST), np.clip(shown, 0, BRIGHTEST)
    return np.abs(exact - shown).mean() / exact.mean()


def differences(roughness, towards, solid, light, normals):
    """Of Karis's shares, of exact ones, and of these with the lobe turned to the normal."""
    alpha = roughness ** 2
    weight, schlick = lobe(normals, towards, alpha)
    white, grazing = (weight @ solid)[:, None], ((weight * schlick) @ solid)[:, None]
    once = COLOR * ((weight * solid) @ light) + (1 - COLOR) * ((weight * schlick * solid) @ light)
    exact = once * (1 + COLOR * (1 - white) / white)
    diffuse = (np.clip(normals @ towards.T, 0, 1) * solid) @ light / np.pi
    nv = (normals @ EYE)[:, None]
    mirrored = 2 * nv * normals - EYE

    def shown(shares, axes):
        single, lost = COLOR * shares[0] + shares[1], 1 - shares[0] - shares[1]
        mean = COLOR + (1 - COLOR) / 21
        return single * around(axes, towards, solid, light, alpha) + lost * single * mean / (1 - lost * mean) * diffuse
    shares, turned = (white - grazing, grazing), unit(mirrored + (normals - mirrored) * alpha ** 2)
    ways = ((karis(roughness, nv), mirrored), (shares, mirrored), (shares, turned))
    return [share_off(exact, shown(*way)) for way in ways]


def integrals(alpha, nv, rings=512, spokes=128):
    """What sharesOfLobe stands for, over half vectors as GGX spreads them."""
    a2, u = alpha * alpha, (np.arange(rings) + 0.5) / rings
    nh = np.sqrt((1 - u) / (1 + (a2 - 1) * u))[:, None]
    turn = np.pi * (np.arange(spokes) + 0.5) / spokes
    vh = np.maximum(np.sqrt(1 - nv * nv) * np.sqrt(1 - nh * nh) * np.cos(turn) + nv * nh, 0)
    nl = np.maximum(2 * vh * nh - nv, 0)
    masking = 2 / (nl * np.sqrt(nv * nv * (1 - a2) + a2) + nv * np.sqrt(nl * nl * (1 - a2) + a2) + 1e-12)
    reflected, schlick = masking * nl * vh / np.maximum(nh, 1e-9), (1 - np.minimum(vh, 1)) ** 5
    return (reflected * (1 - schlick)).mean(), (reflected * schlick).mean()


def fitted(alpha, nv, wanted, above, below, rounds=40):
    """Coefficients of a quotient nearest to `wanted`, by linear fits that are weighed by the denominator before."""
    weight, denominator, best = np.sqrt(np.clip(nv, 0.05, 1)), np.ones_like(wanted), None
    for _ in range(rounds):
        columns = [alpha ** i * nv ** j for i, j in above] + [-wanted * alpha ** i * nv ** j for i, j in below]
        scale = weight / denominator
        found = np.linalg.lstsq(np.stack([c * scale for c in columns], -1).reshape(-1, len(columns)),
                                (wanted * scale).reshape(-1), rcond=1e-12)[0]
        denominator = 1 + sum(c * alpha ** i * nv ** j for c, (i, j) in zip(found[len(above):], below))
        quotient = sum(c * alpha ** i * nv ** j for c, (i, j) in zip(found, above)) / denominator
        rms = np.sqrt(np.mean((weight * (quotient - wanted)) ** 2) / np.mean(weight ** 2))
        if denominator.min() > 0.01 and (best is None or rms < best[0]):
            best = rms, np.abs(quotient - wanted)[nv >= 0.1].max(), found
    return best


def print_fit():
    roughness = np.linspace(0, 1, 33)
    cosines = np.concatenate([[0.01, 0.02, 0.04], np.linspace(0.06, 1, 32)])
    table = np.array([[integrals(max(r * r, 0.002), nv) for nv in cosines] for r in roughness])
    alpha, nv = np.meshgrid(roughness ** 2, cosines, indexing="ij")
    for name, wanted, (above, below) in (("f0", table[..., 0], MIRRORED), ("grazing", table[..., 1], GRAZING)):
        rms, most, found = fitted(alpha, nv, wanted, above, below)
        print(f"{name}: rms {rms:.4f}, at most {most:.4f} where the cosine is 0.1 or more")
        for part, powers, numbers in (("above", above, found), ("below", below, found[len(above):])):
            print(f"  {part}:", ", ".join(f"alpha^{i} nv^{j} {c:.4f}" for (i, j), c in zip(powers, numbers)))


def main(environment):
    picture = rgbe(environment)
    blocks = (HEIGHT, picture.shape[0] // HEIGHT, WIDTH, picture.shape[1] // WIDTH, 3)
    light = picture.reshape(blocks).mean((1, 3)).reshape(-1, 3)
    towards, solid = directions()
    print("| roughness | Karis's shares | exact shares | and turned to the normal |\n|---|---|---|---|")
    for roughness in ROUGHNESS:
        cells = differences(roughness, towards, solid, light, points())
        print(f"| {roughness} | " + " | ".join(f"{100 * cell:.1f} %" for cell in cells) + " |")


if __name__ == "__main__":
    print_fit() if sys.argv[2:] == ["fit"] else main(Path(sys.argv[1]))
