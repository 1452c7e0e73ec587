#!/usr/bin/python3
"""Writes sun_reference.csv: the sun's place by astropy, which solar_position_test.cpp is held against.

usage: sun_reference.py >sun_reference.csv      needs Debian's python3-astropy; no network

The sun's elevation is without air. UT1 is UTC here, as it is in solar_position.h. Terrestrial time is astropy's own by
leap seconds, which has nothing in common with the polynomials of solar_position.cpp.
"""
import random
import warnings

import astropy.units as u
from astropy.coordinates import AltAz, EarthLocation, get_sun
from astropy.time import Time
from astropy.utils import iers

ROWS = 400
FIXED = [
    # NREL's example; a day without a sunset and one without a sunrise; equator at an equinox; both sides of the date
    # line; the south; both poles; the ends of the range.
    ("2003-10-17T19:30:30", 39.742476, -105.1786),
    ("2026-06-21T23:00:00", 69.65, 18.96),
    ("2026-12-21T11:00:00", 69.65, 18.96),
    ("2026-03-20T12:00:00", 0.0, 0.0),
    ("2026-06-21T00:00:00", -16.8, 179.999),
    ("2026-06-21T00:00:00", -16.8, -179.999),
    ("2026-12-21T02:00:00", -33.86, 151.21),
    ("2026-06-21T12:00:00", 90.0, 0.0),
    ("2026-12-21T12:00:00", -90.0, 0.0),
    ("1900-01-01T00:00:00", 48.1, 11.6),
    ("2100-12-31T23:59:59", 48.1, 11.6),
]


def moments():
    chance = random.Random(42)
    yield from FIXED
    for _ in range(ROWS):
        year = chance.randint(1900, 2100)
        time = "%04d-%02d-%02dT%02d:%02d:%02d" % (
            year, chance.randint(1, 12), chance.randint(1, 28), chance.randint(0, 23), chance.randint(0, 59),
            chance.randint(0, 59))
        yield time, round(chance.uniform(-90, 90), 3), round(chance.uniform(-180, 180), 3)


def main():
    iers.conf.auto_download = False
    iers.conf.iers_degraded_accuracy = "ignore"
    warnings.simplefilter("ignore")
    print("time,latitudeDegrees,longitudeDegrees,azimuthDegrees,trueElevationDegrees")
    for text, latitude, longitude in moments():
        time = Time(text, scale="utc")
        time.delta_ut1_utc = 0.0
        place = EarthLocation.from_geodetic(longitude * u.deg, latitude * u.deg, 0 * u.m)
        sun = get_sun(time).transform_to(AltAz(obstime=time, location=place, pressure=0 * u.hPa))
        print("%sZ,%r,%r,%.5f,%.5f" % (text, latitude, longitude, sun.az.deg, sun.alt.deg))


if __name__ == "__main__":
    main()
