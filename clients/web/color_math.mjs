// Colors: "#rrggbb" as people choose them (sRGB), linear red, green and blue as the API takes them. Pure.

const toLinear = (share) => (share <= 0.04045 ? share / 12.92 : ((share + 0.055) / 1.055) ** 2.4);
const fromLinear = (share) => (share <= 0.0031308 ? share * 12.92 : 1.055 * share ** (1 / 2.4) - 0.055);
const byteOf = (share) => Math.round(255 * Math.min(1, Math.max(0, share)));

export const linearOf = (hex) => [1, 3, 5].map((at) => Number(toLinear(parseInt(hex.slice(at, at + 2), 16) / 255).toPrecision(4)));

export const hexOf = (linear) => `#${linear.map((share) => byteOf(fromLinear(share)).toString(16).padStart(2, '0')).join('')}`;
