/** The conformance kit's comparison of a kernel's text with its plugin (agreement.h). */
const agree = (a, b, largest) => Math.abs(a - b) <= 2e-3 * Math.max(Math.abs(a), Math.abs(b)) + 1e-5 * largest + 1e-7;
const MAY_DIFFER = 0.01;  // near a discontinuity, the last bit decides on which side a point is

const largestOf = (values, i) => Math.max(Math.abs(values[i]), Math.abs(values[i + 1]), Math.abs(values[i + 2]));

/** How two arrays of three numbers per point differ: { share, largest (relative to the expected peak; NaN if a value is not a number), differing: by point }. */
export function compareTerm(expected, actual) {
    const count = expected.length / 3, differing = new Array(count);
    let peak = 0, largest = 0, points = 0;
    for (const value of expected) peak = Math.max(peak, Math.abs(value));
    for (let i = 0; i < count; ++i) {
        const scale = largestOf(expected, 3 * i);
        differing[i] = 0;
        for (let c = 3 * i; c < 3 * i + 3; ++c) {
            if (agree(expected[c], actual[c], scale)) continue;
            const difference = Math.abs(expected[c] - actual[c]) / (peak || 1);
            differing[i] = Math.max(differing[i], difference);
            largest = Number.isFinite(difference) && Number.isFinite(largest) ? Math.max(largest, difference) : NaN;
        }
        if (differing[i] !== 0) points += 1;
    }
    return { share: points / count, largest, differing };
}

/** The differences of a term in the worst of all cases: { share, largest, worst: the case's index, matches }. */
export function compareAll(expected, actual, term) {
    const found = expected.map((one, i) => compareTerm(one[term], actual[i][term]));
    let worst = 0;
    found.forEach(({ share }, i) => { if (share > found[worst].share) worst = i; });
    return { ...found[worst], worst, matches: found.every(({ share }) => share <= MAY_DIFFER) };
}
