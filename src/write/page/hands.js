/* ---- the crease pattern of the moment ---- */

/* Creases that moved are where they are now, and stronger the farther they are folded. */
function plan(time) {
    const cp = $('cp'), ratio = window.devicePixelRatio || 1,
        most = Math.max(96, Math.min(300, 0.3 * Math.min(innerWidth, innerHeight) + 40));
    const w = box[2] - box[0], h = box[3] - box[1], scale = most / Math.max(w, h), pad = 8;
    const width = Math.round(w * scale + 2 * pad), height = Math.round(h * scale + 2 * pad);
    if (cp.style.width !== width + 'px' || cp.style.height !== height + 'px') {
        cp.style.width = width + 'px', cp.style.height = height + 'px';
    }
    cp.width = width * ratio, cp.height = height * ratio;
    const g = cp.getContext('2d'), k = Math.min(Math.floor(time), frames - 1), next = Math.min(k + 1, frames - 1),
        s = time - k;
    const a = D.frames[k].flat || pattern, b = D.frames[next].flat || pattern;
    const X = v => ratio * (width / 2 + scale * (a[2 * v] + s * (b[2 * v] - a[2 * v]) - middle[0]));
    const Y = v => ratio * (height / 2 - scale * (a[2 * v + 1] + s * (b[2 * v + 1] - a[2 * v + 1]) - middle[1]));
    g.fillStyle = 'rgb(' + D.paper.back.join() + ')';
    g.beginPath();
    for (let f = 0; f < facets; f++)
        for (let j = start[f], v; j < start[f + 1]; j++)
            v = D.vertex[j], j === start[f] ? g.moveTo(X(v), Y(v)) : g.lineTo(X(v), Y(v));
    g.fill();
    /* less where facets are small */
    const thin = Math.max(0.5, Math.min(1.4, 0.25 * scale * Math.sqrt(w * h / facets))) * ratio;
    for (let e = 0; e < edges; e++) {
        const kind = D.assignment[e], [f, o] = sides[e];
        const n = [normal[3 * f], normal[3 * f + 1], normal[3 * f + 2]];
        const fold = o === undefined ? 1 : Math.acos(Math.max(-1, Math.min(1, dot(n, normal, 3 * o)))) / Math.PI;
        g.globalAlpha = kind === 'B' ? 1 : kind === 'F' ? 0.15 + 0.5 * fold : 0.45 + 0.55 * fold;
        g.strokeStyle = kind === 'F' ? '#777' : 'rgb(' + (INK[kind] || INK.B).join() + ')';
        g.lineWidth = kind === 'F' ? 0.6 * thin : thin;
        g.beginPath();
        g.moveTo(X(D.ends[2 * e]), Y(D.ends[2 * e]));
        g.lineTo(X(D.ends[2 * e + 1]), Y(D.ends[2 * e + 1]));
        g.stroke();
    }
    g.globalAlpha = 1;
}

/* ---- the page ---- */

const luma = (299 * D.paper.background[0] + 587 * D.paper.background[1] + 114 * D.paper.background[2]) / 1000;
document.body.style.background = 'rgb(' + D.paper.background.join() + ')';
document.body.style.setProperty('--ink', luma < 128 ? '#e8eaee' : '#223');
document.body.classList.toggle('light', luma >= 128);
const target = document.createElement('canvas');
target.tabIndex = 0;
target.setAttribute('aria-label', 'the folded sheet');
$('view').append(target);
let draw = null;
try {
    draw = makeGl(target);
} catch (e) {
    console.error(e);
}
target.addEventListener('webglcontextlost', e => e.preventDefault());
target.addEventListener('webglcontextrestored', () => { draw = makeGl(target); touch(); });

/* Time is counted in frames. At the ends the motion rests, as it does in films. */
let time = 0, playing = false, direction = 1, before = 0, waiting = false, rest = 0;
const SECONDS = Math.max(4, frames / 30);

function touch() {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(paint);
}

function paint(now) {
    waiting = false;
    if (playing && rest > 0) {
        rest -= Math.min(now - before, 100) / 1000;
    } else if (playing) {
        time += direction * Math.min(now - before, 100) / 1000 / SECONDS * (frames - 1);
        if (time >= frames - 1 || time <= 0) direction = time <= 0 ? 1 : -1, rest = D.hold * (time <= 0 ? 0.5 : 1);
    }
    before = now;
    time = Math.max(0, Math.min(frames - 1, time));
    const ratio = window.devicePixelRatio || 1, w = Math.round(target.clientWidth * ratio),
        h = Math.round(target.clientHeight * ratio);
    if (target.width !== w || target.height !== h) target.width = w, target.height = h;
    const percent = pose(time);
    if (!$('cp').hidden) plan(time);
    if (w && h && draw) draw(time, ratio, D.frames[Math.round(time)].tint);
    $('slider').value = frames > 1 ? 100 * time / (frames - 1) : 0;
    $('percent').value = percent.toFixed(1) + ' %';
    tell(percent);
    if (playing) touch();
}

function play(on) {
    playing = on && frames > 1;
    if (playing && time >= frames - 1) direction = -1;
    if (playing && time <= 0) direction = 1;
    rest = 0;
    $('play').textContent = playing ? '\u275a\u275a' : '\u25b6';
    $('play').setAttribute('aria-label', playing ? 'Pause' : 'Play');
    before = performance.now();
    touch();
}
function go(to) {
    play(false);
    time = Math.max(0, Math.min(frames - 1, to));
    touch();
}
/* When it is first folded that far; the end where it never is. */
function timeOf(percent) {
    for (let k = 0; k < frames; k++) {
        const p = D.frames[k].percent, q = k > 0 ? D.frames[k - 1].percent : p;
        if (Math.abs(p) >= Math.abs(percent) - 1e-9)
            return k > 0 && p !== q ? k - Math.abs((p - percent) / (p - q)) : k;
    }
    return frames - 1;
}
function fromHash() {
    const words = location.hash.slice(1).split('&'), value = parseFloat(words[0]);
    document.body.classList.toggle('bare', words.includes('bare'));
    if (value >= -100 && value <= 100) go(timeOf(value));
    else touch();
}
function turnBy(dx, dy) {
    view.azimuth -= 0.008 * dx;
    view.elevation = Math.max(-Math.PI / 2, Math.min(Math.PI / 2, view.elevation + 0.008 * dy));
    touch();
}
function move(dx, dy) {
    view.x += dx;
    view.y += dy;
    touch();
}
function zoom(by) {
    view.zoom = Math.max(0.3, Math.min(30, view.zoom * by));
    touch();
}

/* ---- messages, of a page that this one is in a frame of ---- */

const DEG = Math.PI / 180, framed = window.parent !== window;
let told = '';
function tell(percent) {
    if (!framed) return;
    const state = { percent, frame: time, frames, playing, azimuth: view.azimuth / DEG, elevation: view.elevation / DEG,
                   zoom: view.zoom };
    const text = JSON.stringify(state);
    if (text === told) return;
    told = text;
    window.parent.postMessage({ rigami: state }, '*');
}
addEventListener('message', e => {
    const m = e.data && e.data.rigami;
    if (!framed || e.source !== window.parent || !m || typeof m !== 'object') return;
    const number = (key, low, high) => typeof m[key] === 'number' && m[key] >= low && m[key] <= high;
    if (number('percent', -100, 100)) go(timeOf(m.percent));
    if (number('frame', 0, frames - 1)) go(m.frame);
    if (number('azimuth', -1e6, 1e6)) view.azimuth = m.azimuth * DEG;
    if (number('elevation', -90, 90)) view.elevation = m.elevation * DEG;
    if (number('zoom', 0.3, 30)) view.zoom = m.zoom;
    if (typeof m.play === 'boolean') play(m.play);
    if (typeof m.bare === 'boolean') document.body.classList.toggle('bare', m.bare);
    if (m.reset === true) reset();
    touch();
});

/* ---- hands ---- */

function togglePlan() {
    $('cp').hidden = !$('cp').hidden;
    $('cp').style.display = $('cp').hidden ? 'none' : '';
    touch();
}
$('play').addEventListener('click', () => play(!playing));
$('plan').addEventListener('click', togglePlan);
$('slider').addEventListener('input', () => go($('slider').value / 100 * (frames - 1)));
const pointers = new Map();
target.addEventListener('pointerdown', e => {
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    target.setPointerCapture(e.pointerId);
    target.focus();
});
target.addEventListener('pointermove', e => {
    const was = pointers.get(e.pointerId);
    if (!was) return;
    const now = [e.clientX, e.clientY], dx = now[0] - was[0], dy = now[1] - was[1];
    if (pointers.size === 2) {
        const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
        const span = p => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
        zoom(span(now) / span(was));
        move(dx / 2, dy / 2);
    } else if (e.shiftKey || e.buttons > 1) {
        move(dx, dy);
    } else {
        turnBy(dx, dy);
    }
    pointers.set(e.pointerId, now);
});
for (const end of ['pointerup', 'pointercancel']) target.addEventListener(end, e => pointers.delete(e.pointerId));
target.addEventListener('contextmenu', e => e.preventDefault());
target.addEventListener('dblclick', () => { reset(); touch(); });
target.addEventListener('wheel', e => {
    e.preventDefault();
    zoom(Math.exp(-0.0015 * e.deltaY * (e.deltaMode ? 30 : 1)));
}, { passive: false });
addEventListener('keydown', e => {
    if (e.ctrlKey || e.metaKey || e.altKey) return;
    const frame = Math.round(time);
    const keys = { ' ': () => play(!playing), ArrowRight: () => go(frame + 1), ArrowLeft: () => go(frame - 1),
                   ArrowUp: () => zoom(1.1), ArrowDown: () => zoom(1 / 1.1), Home: () => go(0),
                       End: () => go(frames - 1),
                   r: () => { reset(); touch(); }, c: togglePlan };
    const act = keys[e.key.length === 1 ? e.key.toLowerCase() : e.key];
    if (!act) return;
    e.preventDefault();
    act();
});
addEventListener('resize', touch);
addEventListener('hashchange', fromHash);
document.title = (D.title || 'crease pattern') + ' - rigami';
$('title').textContent = D.title;
$('author').textContent = D.author;
$('told').textContent = (draw ? '' : 'This browser has no WebGL 2, so that it cannot draw the sheet. ') + D.told;
if (D.crosses !== null && frames > 1) {
    $('mark').style.display = 'block';
    $('mark').style.left = 100 * timeOf(D.crosses) / (frames - 1) + '%';
}
fromHash();
