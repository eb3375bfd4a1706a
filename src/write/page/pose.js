/* ---- data ---- */

function bytesOf(text) {
    const raw = atob(text), bytes = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i++) bytes[i] = raw.charCodeAt(i);
    return bytes;
}
function floats(text) {
    const bytes = bytesOf(text), view = new DataView(bytes.buffer), out = new Float32Array(bytes.length / 4);
    for (let i = 0; i < out.length; i++) out[i] = view.getFloat32(4 * i, true);
    return out;
}
const facets = D.corners.length, frames = D.frames.length, start = [0];
for (const n of D.corners) start.push(start[start.length - 1] + n);
const corners = start[facets];
/* Pieces of facets that lie elsewhere at the end, where its layers go in a circle; they come after the facets. */
const pieces = D.patches || { facet: [], corners: [], edge: [], at: [], lift: [] }, all = facets + pieces.facet.length;
for (const n of pieces.corners) start.push(start[start.length - 1] + n);
const allCorners = start[all], edges = D.ends.length / 2;
const pattern = floats(D.pattern), flat = new Float32Array(2 * corners), uv = new Float32Array(2 * allCorners);
const middle = [0, 0]; /* of the pattern's box */
const box = [Infinity, Infinity, -Infinity, -Infinity];
for (let i = 0; i < pattern.length; i++) {
    box[i % 2] = Math.min(box[i % 2], pattern[i]);
    box[2 + i % 2] = Math.max(box[2 + i % 2], pattern[i]);
}
for (let i = 0; i < 2; i++) middle[i] = (box[i] + box[i + 2]) / 2;
const sides = Array.from({ length: edges }, () => []); /* the facets at each edge */
for (let f = 0; f < facets; f++) {
    const c = [0, 0];
    for (let j = start[f]; j < start[f + 1]; j++)
        for (let i = 0; i < 2; i++) c[i] += pattern[2 * D.vertex[j] + i] / (start[f + 1] - start[f]);
    for (let j = start[f]; j < start[f + 1]; j++) {
        for (let i = 0; i < 2; i++) {
            const x = pattern[2 * D.vertex[j] + i], part = (x - box[i]) / (box[i + 2] - box[i]);
            flat[2 * j + i] = x - c[i]; /* corners about the centre of their facet */
            uv[2 * j + i] = i ? 1 - part : part;
        }
        sides[D.edge[j]].push(f);
    }
}
for (const f of D.frames) {
    f.points = floats(f.points);
    f.lift = f.lift ? floats(f.lift) : null;
    f.tint = f.tint ? bytesOf(f.tint) : null;
    f.flat = f.flat ? floats(f.flat) : null;
    f.pose = D.rigid ? turnsAndShifts(f.points) : f.points;
}

/* The turn of each facet, a quaternion, and where its centre is, from where its corners are: its plane, and in it the
 * way to the corner that is furthest from the centre. */
function turnsAndShifts(points) {
    const out = new Float32Array(7 * facets), at = (j, i) => points[3 * D.vertex[j] + i];
    for (let f = 0; f < facets; f++) {
        const c = [0, 0, 0], n = [0, 0, 0], u = [0, 0, 0], count = start[f + 1] - start[f];
        let far = start[f];
        for (let j = start[f], k = start[f + 1] - 1; j < start[f + 1]; k = j++) {
            if (Math.hypot(flat[2 * j], flat[2 * j + 1]) > Math.hypot(flat[2 * far], flat[2 * far + 1])) far = j;
            for (let i = 0; i < 3; i++) c[i] += at(j, i) / count;
        }
        for (let j = start[f], k = start[f + 1] - 1; j < start[f + 1]; k = j++)
            for (let i = 0, y = 1, z = 2; i < 3; i++, y = z, z = (z + 1) % 3)
                n[i] += (at(k, y) - c[y]) * (at(j, z) - c[z]) - (at(k, z) - c[z]) * (at(j, y) - c[y]);
        const long = Math.hypot(...n) || 1;
        for (let i = 0; i < 3; i++) n[i] /= long;
        for (let i = 0; i < 3; i++) u[i] = at(far, i) - c[i];
        const off = u[0] * n[0] + u[1] * n[1] + u[2] * n[2];
        for (let i = 0; i < 3; i++) u[i] -= off * n[i];
        const reach = Math.hypot(...u) || 1, radius = Math.hypot(flat[2 * far], flat[2 * far + 1]) || 1;
        const x = flat[2 * far] / radius, y = flat[2 * far + 1] / radius, R = [[], [], []];
        for (let i = 0; i < 3; i++) {
            const a = u[i] / reach, b = (n[(i + 1) % 3] * u[(i + 2) % 3] - n[(i + 2) % 3] * u[(i + 1) % 3]) / reach;
            R[i] = [x * a - y * b, y * a + x * b, n[i]];
        }
        out.set(quaternion(R), 7 * f);
        out.set(c, 7 * f + 4);
    }
    return out;
}

/* Of a rotation matrix, by its largest part. */
function quaternion(R) {
    const trace = R[0][0] + R[1][1] + R[2][2];
    if (trace > 0) {
        const s = 2 * Math.sqrt(1 + trace);
        return [(R[2][1] - R[1][2]) / s, (R[0][2] - R[2][0]) / s, (R[1][0] - R[0][1]) / s, s / 4];
    }
    const i = R[0][0] > R[1][1] ? (R[0][0] > R[2][2] ? 0 : 2) : R[1][1] > R[2][2] ? 1 : 2;
    const j = (i + 1) % 3, k = (i + 2) % 3;
    const s = 2 * Math.sqrt(1 + R[i][i] - R[j][j] - R[k][k]), q = [0, 0, 0, (R[k][j] - R[j][k]) / s];
    q[i] = s / 4;
    q[j] = (R[j][i] + R[i][j]) / s;
    q[k] = (R[k][i] + R[i][k]) / s;
    return q;
}

/* ---- pose: corners of all facets at a time 0 ... frames - 1, and their normals ---- */

const P = new Float32Array(3 * allCorners), normal = new Float32Array(3 * all);
let shown = facets; /* with the pieces, or without */

function slerp(p, q, f, s, out) {
    const a = 7 * f;
    let d = p[a] * q[a] + p[a + 1] * q[a + 1] + p[a + 2] * q[a + 2] + p[a + 3] * q[a + 3], u = 1 - s, v = s;
    if (Math.abs(d) < 0.9999) {
        const angle = Math.acos(Math.abs(d));
        u = Math.sin((1 - s) * angle) / Math.sin(angle);
        v = Math.sin(s * angle) / Math.sin(angle);
    }
    if (d < 0) v = -v;
    let length = 0;
    for (let i = 0; i < 4; i++) length += (out[i] = u * p[a + i] + v * q[a + i]) ** 2;
    for (let i = 0; i < 4; i++) out[i] /= Math.sqrt(length);
}

function poseRigid(p, q, s) {
    const t = [0, 0, 0, 1];
    for (let f = 0; f < facets; f++) {
        slerp(p, q, f, s, t);
        const [x, y, z, w] = t, a = 7 * f + 4;
        const ux = 1 - 2 * (y * y + z * z), uy = 2 * (x * y + z * w), uz = 2 * (x * z - y * w);
        const vx = 2 * (x * y - z * w), vy = 1 - 2 * (x * x + z * z), vz = 2 * (y * z + x * w);
        const tx = p[a] + s * (q[a] - p[a]), ty = p[a + 1] + s * (q[a + 1] - p[a + 1]),
            tz = p[a + 2] + s * (q[a + 2] - p[a + 2]);
        for (let j = start[f]; j < start[f + 1]; j++) {
            const X = flat[2 * j], Y = flat[2 * j + 1];
            P[3 * j] = ux * X + vx * Y + tx;
            P[3 * j + 1] = uy * X + vy * Y + ty;
            P[3 * j + 2] = uz * X + vz * Y + tz;
        }
    }
}

function posePoints(p, q, s) {
    for (let j = 0; j < corners; j++)
        for (let i = 0, v = 3 * D.vertex[j]; i < 3; i++) P[3 * j + i] = p[v + i] + s * (q[v + i] - p[v + i]);
}

function lift(a, b, s) {
    if (!a && !b) return;
    for (let f = 0; f < facets; f++)
        for (let i = 0; i < 3; i++) {
            const by = (a ? a[3 * f + i] : 0) * (1 - s) + (b ? b[3 * f + i] : 0) * s;
            for (let j = start[f]; j < start[f + 1]; j++) P[3 * j + i] += by;
        }
}

/* A piece lies in its facet: its corners are sums of three of the facet's, by the pattern; then it is moved off it. */
const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
const shares = pieces.facet.map((f, k) => {
    const at = j => [0, 1].map(i => pattern[2 * D.vertex[j] + i]), o = start[f];
    let best = [o, o, o], most = 0;
    for (let a = o + 1; a < start[f + 1]; a++)
        for (let b = a + 1; b < start[f + 1]; b++) {
            const area = Math.abs(turn(at(o), at(a), at(b)));
            if (area > most) most = area, best = [o, a, b];
        }
    const [p, q, r] = best.map(at), whole = turn(p, q, r) || 1, out = [];
    for (let j = start[facets + k]; j < start[facets + k + 1]; j++) {
        const x = [0, 1].map(i => pieces.at[2 * (j - corners) + i]);
        for (let i = 0; i < 2; i++) {
            const part = (x[i] - box[i]) / (box[i + 2] - box[i]);
            uv[2 * j + i] = i ? 1 - part : part;
        }
        out.push([turn(x, q, r) / whole, turn(p, x, r) / whole, turn(p, q, x) / whole]);
    }
    return { corner: best, of: out };
});
D.edge.push(...pieces.edge);
pieces.facet.forEach((_, k) => {
    const at = 2 * (start[facets + k] - corners);
    D.triangles.push(...ears(shares[k].of.map((_, i) => [pieces.at[at + 2 * i], pieces.at[at + 2 * i + 1]])));
});

/* A polygon as triangles, an ear at a time. */
function ears(x) {
    const left = x.map((_, i) => i), out = [];
    let way = 0;
    for (let i = 0, k = x.length - 1; i < x.length; k = i++) way += x[k][0] * x[i][1] - x[i][0] * x[k][1];
    way = way < 0 ? -1 : 1;
    while (left.length > 2) {
        const n = left.length, of = i => [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
        const is = i => {
            const [a, b, c] = of(i);
            return way * turn(x[a], x[b], x[c]) > 0 && left.every(p => p === a || p === b || p === c ||
                way * turn(x[a], x[b], x[p]) < 0 || way * turn(x[b], x[c], x[p]) < 0 ||
                    way * turn(x[c], x[a], x[p]) < 0);
        };
        let i = left.findIndex((_, k) => is(k));
        if (i < 0) i = 0; /* of no area */
        out.push(...of(i));
        left.splice(i, 1);
    }
    return out;
}

function placePieces() {
    shares.forEach(({ corner, of }, k) => of.forEach((w, n) => {
        for (let i = 0, j = start[facets + k] + n; i < 3; i++)
            P[3 * j + i] = w.reduce((sum, share, v) => sum + share * P[3 * corner[v] + i], pieces.lift[3 * k + i]);
    }));
}

function normals() {
    for (let f = 0; f < shown; f++) {
        let x = 0, y = 0, z = 0;
        for (let j = start[f], k = start[f + 1] - 1; j < start[f + 1]; k = j++) {
            const a = 3 * k, b = 3 * j;
            x += (P[a + 1] - P[b + 1]) * (P[a + 2] + P[b + 2]);
            y += (P[a + 2] - P[b + 2]) * (P[a] + P[b]);
            z += (P[a] - P[b]) * (P[a + 1] + P[b + 1]);
        }
        const length = Math.hypot(x, y, z) || 1;
        normal[3 * f] = x / length;
        normal[3 * f + 1] = y / length;
        normal[3 * f + 2] = z / length;
    }
}

function pose(time) {
    const k = Math.min(Math.floor(time), frames - 1), next = Math.min(k + 1, frames - 1), s = time - k;
    const a = D.frames[k], b = D.frames[next];
    (D.rigid ? poseRigid : posePoints)(a.pose, b.pose, s);
    lift(a.lift, b.lift, s);
    shown = time >= frames - 1 ? all : facets;
    if (shown > facets) placePieces();
    normals();
    return a.percent + s * (b.percent - a.percent);
}

