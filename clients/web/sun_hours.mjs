// Place and day of the view of sun hours. Pure.

const kDayMs = 86_400_000;
const kFirstPlace = { latitudeDegrees: 48, longitudeDegrees: 12 };
const kFirstDate = '2026-03-20';

const two = (number) => String(number).padStart(2, '0');

// Of the clock of the place's mean sun: "+00:48".
function zoneAt(longitudeDegrees) {
  const minutes = Math.round(4 * Math.min(180, Math.max(-180, longitudeDegrees)));
  const size = Math.abs(minutes);
  return `${minutes < 0 ? '-' : '+'}${two(Math.floor(size / 60))}:${two(size % 60)}`;
}

// From midnight to midnight.
function dayOf(date, zone) {
  const next = new Date(Date.parse(`${date}T00:00:00Z`) + kDayMs).toISOString().slice(0, 10);
  return { begin: `${date}T00:00:00${zone}`, end: `${next}T00:00:00${zone}` };
}

// The day of the first sun by place and time, by its clock.
function hoursOfSun({ lights, environment }) {
  const suns = [...(lights ?? []).map((light) => light.sun), environment?.sky?.sun];
  const sun = suns.find((each) => each?.time);
  const [, date, zone] = /^(\d{4}-\d\d-\d\d)T.*?(Z|[+-]\d\d:\d\d)$/i.exec(sun?.time ?? '') ?? [];
  if (!date) return null;
  const { time, ...place } = sun;
  return { ...place, ...dayOf(date, zone) };
}

// Those of the user, else those of a sun by place and time, else of a first place and day.
export const sunHoursInForce = (spec) => spec.sunHours ?? hoursOfSun(spec) ?? { ...kFirstPlace, ...dayOf(kFirstDate, zoneAt(kFirstPlace.longitudeDegrees)) };

export const dateOf = ({ begin }) => String(begin ?? '').slice(0, 10);

export const withDate = (hours, date) => ({ ...hours, ...dayOf(date, zoneAt(hours.longitudeDegrees)) });
