/* ---- camera ---- */

/* The same steady move as in pictures, for this window; turned by hand, it goes as far back as it takes. */
const LENS = 7, MARGIN = 0.06, REACH = 0.1, FLOOR = 0.01;
const dot = (v, a, i = 0) => v[0] * a[i] + v[1] * a[i + 1] + v[2] * a[i + 2];
const view = {};
const reset = () => Object.assign(view, {
    azimuth: D.camera.azimuth, elevation: D.camera.elevation, roll: D.camera.roll, zoom: D.camera.zoom,
    x: 0, y: 0 });
reset();

function axes(azimuth, elevation, roll) {
    const ca = Math.cos(azimuth), sa = Math.sin(azimuth), ce = Math.cos(elevation), se = Math.sin(elevation);
    const c = Math.cos(roll), s = Math.sin(roll), r = [-sa, ca, 0], u = [-se * ca, -se * sa, ce];
    return { right: r.map((v, i) => c * v + s * u[i]), up: u.map((v, i) => c * v - s * r[i]),
            back: [ce * ca, ce * sa, se] };
}

/* What a window leaves for the sheet, in its pixels; the pattern is beside it or below. */
function room() {
    const w = innerWidth, h = innerHeight, bare = document.body.classList.contains('bare');
    const r = { left: 0, top: 0, right: w, bottom: h };
    if (!bare) {
        r.top = Math.min($('words').offsetHeight + 12, h / 3);
        r.bottom = h - 62;
        const cp = $('cp');
        if (!cp.hidden) {
            if (w > h) r.right -= cp.offsetWidth + 16;
            else r.bottom -= cp.offsetHeight + 14;
        }
    }
    return r;
}
const lensOf = r => { /* half the width and the height that the sheet may take, over its distance */
    const w = (r.right - r.left) / 2, h = (r.bottom - r.top) / 2, scale = LENS * Math.min(w, h);
    return { scale, wide: (1 - 2 * MARGIN) * w / scale, high: (1 - 2 * MARGIN) * h / scale };
};

let size = 0; /* of the sheet */
for (let i = 0; i < 2; i++) size = Math.max(size, box[i + 2] - box[i]);

function smooth(a, above) {
    const reach = Math.floor(REACH * frames), at = k => a[Math.max(0, Math.min(frames - 1, k))];
    if (above) a = a.map((v, k) => { for (let i = -reach; i <= reach; i++) v = Math.max(v, at(k + i)); return v; });
    return a.map((_, k) => {
        let sum = 0, weights = 0;
        for (let i = -reach; i <= reach; i++) {
            const w = 1 + reach - Math.abs(i);
            sum += w * at(k + i);
            weights += w;
        }
        return sum / weights;
    });
}

/* Most of b + r / w and the like, of points (r, u, b) about a middle. */
function extent(points, A, lens, r0, u0) {
    const e = { right: -Infinity, left: -Infinity, top: -Infinity, bottom: -Infinity, front: -Infinity, back: Infinity,
               ground: Infinity };
    for (let i = 0; i < points.length; i += 3) {
        const r = (dot(A.right, points, i) - r0) / lens.wide, u = (dot(A.up, points, i) - u0) / lens.high,
            b = dot(A.back, points, i);
        e.right = Math.max(e.right, b + r), e.left = Math.max(e.left, b - r), e.top = Math.max(e.top, b + u),
            e.bottom = Math.max(e.bottom, b - u);
        e.front = Math.max(e.front, b), e.back = Math.min(e.back, b), e.ground = Math.min(e.ground, points[i + 2]);
    }
    return e;
}

function middleOf(points, A, lens) {
    const e = extent(points, A, lens, 0, 0), across = (e.right + e.left) / 2, along = (e.top + e.bottom) / 2;
    const eye = [lens.wide * (e.right - e.left) / 2, lens.high * (e.top - e.bottom) / 2, Math.max(across, along)],
        slack = across < along ? 0 : 1;
    for (let round = 0; round < 4; round++) {
        let low = Infinity, high = -Infinity;
        for (let i = 0; i < points.length; i += 3) {
            const x = (dot(slack ? A.up : A.right, points, i) - eye[slack]) / (eye[2] - dot(A.back, points, i));
            low = Math.min(low, x), high = Math.max(high, x);
        }
        eye[slack] += (low + high) / 2 * (eye[2] - (e.front + e.back) / 2);
    }
    return eye;
}

let path = null, pathFor = '';
function follow() {
    const r = room(), lens = lensOf(r), key = [r.left, r.top, r.right, r.bottom].join();
    if (key === pathFor) return path;
    const A = axes(D.camera.azimuth, D.camera.elevation, D.camera.roll),
        eyes = D.frames.map(f => middleOf(f.points, A, lens));
    const x = smooth(eyes.map(e => e[0])), y = smooth(eyes.map(e => e[1]));
    const extents = D.frames.map((f, k) => extent(f.points, A, lens, x[k], y[k]));
    const away = smooth(extents.map(e => Math.max(e.right, e.left, e.top, e.bottom)), true);
    const deep = smooth(extents.map(e => (e.front + e.back) / 2));
    pathFor = key;
    path = { A, lens, r, x, y, deep, away: away.map((d, k) => d - deep[k]),
            ground: smooth(extents.map(e => -e.ground), true).map(v => -v - FLOOR * size) };
    return path;
}

/* Of a canvas with `ratio` pixels for each of the window's. */
function camera(time, ratio, width, height) {
    const p = follow(), k = Math.min(Math.floor(time), frames - 1), next = Math.min(k + 1, frames - 1), s = time - k;
    const at = a => a[k] + s * (a[next] - a[k]), A = axes(view.azimuth, view.elevation, view.roll), o = p.A;
    const middle = [0, 1, 2].map(i => at(p.x) * o.right[i] + at(p.y) * o.up[i] + at(p.deep) * o.back[i]);
    let need = 0, front = -Infinity, rear = Infinity;
    for (let j = 0; j < P.length; j += 3) {
        const d = [P[j] - middle[0], P[j + 1] - middle[1], P[j + 2] - middle[2]], b = dot(A.back, d);
        need = Math.max(need, b + Math.abs(dot(A.right, d)) / p.lens.wide, b + Math.abs(dot(A.up, d)) / p.lens.high);
        front = Math.max(front, b), rear = Math.min(rear, b);
    }
    const away = Math.max(at(p.away), need), pad = 0.02 * size, scale = p.lens.scale * view.zoom * ratio;
    const w = p.r.right - p.r.left, h = p.r.bottom - p.r.top;
    /* However it is moved, its middle stays in the window. */
    const most = [w / 2 * Math.max(1, view.zoom), h / 2 * Math.max(1, view.zoom)];
    view.x = Math.max(-most[0], Math.min(most[0], view.x));
    view.y = Math.max(-most[1], Math.min(most[1], view.y));
    return { ...A, eye: middle.map((m, i) => m + away * A.back[i]), scale, near: away - front - pad,
             far: away - rear + pad, ground: at(p.ground), x: ((p.r.left + p.r.right) / 2 + view.x) * ratio,
             y: height - ((p.r.top + p.r.bottom) / 2 + view.y) * ratio, width, height,
             shorter: Math.min(w, h) * ratio };
}

/* World to clip space, column by column. A point is seen at x + scale r / away, y + scale u / away, y up. */
function matrix(c) {
    const rows = [c.right.map((v, i) => (2 * c.scale * v - (2 * c.x - c.width) * c.back[i]) / c.width),
                  c.up.map((v, i) => (2 * c.scale * v - (2 * c.y - c.height) * c.back[i]) / c.height),
                  c.back.map(v => v * (c.far + c.near) / (c.near - c.far)), c.back.map(v => -v)];
    const out = [];
    for (let i = 0; i < 3; i++) for (let r = 0; r < 4; r++) out.push(rows[r][i]);
    for (let r = 0; r < 4; r++) out.push(-dot(rows[r], c.eye) + (r === 2 ? 2 * c.far * c.near / (c.near - c.far) : 0));
    return new Float32Array(out);
}

