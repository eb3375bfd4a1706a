/* ---- what is seen of a facet: side, colour, width, and its depth at every pixel ---- */

const INK = { M: [200, 44, 44], V: [36, 84, 190], U: [120, 112, 108], B: [58, 48, 44] }, EDGE = [84, 72, 66];
const KEY = [-0.48, 0.55, 0.68], FILL = [0.75, -0.20, 0.63], HALF = 1 / 720, SHARE = 0.06;
const shade = new Float32Array(3 * all), lit = new Float32Array(3 * all), isFront = new Uint8Array(all),
    wide = new Float32Array(all);
const depth = new Float64Array(5 * all), screen = new Float64Array(2 * allCorners);
const TIE = 1e-6; /* a line is drawn by so much depth before its facet */

/* Depth is linear on the screen, 0 near ... 1 far: depth[5f] x + depth[5f + 1] y + depth[5f + 2], x and y in pixels
 * from where the camera looks, y up; it lies between depth[5f + 3] and depth[5f + 4]. Taken from the facet's plane, for
 * corners are moved to some fraction of a pixel when they are drawn, which is more than what lies between two layers of
 * a folded sheet. */
function look(c, tint) {
    const range = 1 / c.near - 1 / c.far, deep = z => (1 / c.near - 1 / Math.max(z, c.near)) / range;
    const n = [0, 0, 0], X = [0, 0, 0];
    for (let f = 0; f < shown; f++) {
        const own = f < facets ? f : pieces.facet[f - facets];
        let low = 1, high = 0, area = 0, round = 0;
        for (let i = 0; i < 3; i++) n[i] = normal[3 * f + i];
        for (let j = start[f]; j < start[f + 1]; j++) {
            for (let i = 0; i < 3; i++) X[i] = P[3 * j + i] - c.eye[i];
            const away = Math.max(-dot(c.back, X), 1e-9), d = deep(away);
            screen[2 * j] = c.scale * dot(c.right, X) / away, screen[2 * j + 1] = c.scale * dot(c.up, X) / away;
            low = Math.min(low, d), high = Math.max(high, d);
        }
        for (let j = start[f], k = start[f + 1] - 1; j < start[f + 1]; k = j++) {
            area += screen[2 * k] * screen[2 * j + 1] - screen[2 * j] * screen[2 * k + 1];
            round += Math.hypot(screen[2 * j] - screen[2 * k], screen[2 * j + 1] - screen[2 * k + 1]);
        }
        wide[f] = f < facets ? (round > 0 ? Math.abs(area) / round : 0) : wide[own];
        const to = dot(n, X), front = to < 0, way = front ? 1 : -1,
            along = [c.right, c.up, c.back].map(a => way * dot(n, a));
        const level = Math.min(1, 0.68 + 0.32 * Math.max(0, dot(KEY, along)) + 0.12 * Math.max(0, dot(FILL, along)));
        const light = [level ** 0.8, level ** 0.92, level], paper = front ? D.paper.front : D.paper.back;
        isFront[f] = front ? 1 : 0;
        for (let i = 0; i < 3; i++) {
            lit[3 * f + i] = 255 * light[i];
            shade[3 * f + i] = (tint ? tint[3 * own + i] : paper[i]) * light[i];
        }
        const flatOn = Math.abs(to) > 1e-9 * size ? 1 / (to * range) : 0; /* edge on, any depth of it will do */
        depth[5 * f] = -dot(n, c.right) / c.scale * flatOn;
        depth[5 * f + 1] = -dot(n, c.up) / c.scale * flatOn;
        depth[5 * f + 2] = flatOn ? 1 / c.near / range + dot(n, c.back) * flatOn : low;
        depth[5 * f + 3] = low;
        depth[5 * f + 4] = high;
    }
}

/* The colour of an edge of a facet, null: no line. An added crease is one where it is an outline. */
function inkOf(j, f) {
    if (D.edge[j] < 0) return null;
    const kind = D.assignment[D.edge[j]], [a, b] = sides[D.edge[j]];
    if (kind === 'F') return b !== undefined && isFront[a] !== isFront[b] ? INK.B : null;
    return kind === 'B' ? INK.B : D.lines === 2 ? EDGE : INK[kind] || INK.B;
}

/* ---- the shadow on the floor: which cells are dark, blurred by running means ---- */

const SIDE = 128, BLUR = 4, TIMES = 3, DARKEST = 0.4;
const dark = new Float32Array(SIDE * SIDE), row = new Float32Array(SIDE), pixels = new Uint8Array(SIDE * SIDE);
const floor = { x: 0, y: 0, cell: 0 };

function cast(c) {
    if (!D.shadow || !(c.back[2] > 0.05)) return false;
    const lamp = [0, 1].map(i => -0.3 * c.right[i] - 0.1 * c.back[i]);
    const at = j => [0, 1].map(i => P[3 * j + i] - (P[3 * j + 2] - c.ground) * lamp[i]);
    const low = [Infinity, Infinity], high = [-Infinity, -Infinity], spots = [];
    for (let j = 0; j < corners; j++) {
        spots.push(at(j));
        for (let i = 0; i < 2; i++) low[i] = Math.min(low[i], spots[j][i]), high[i] = Math.max(high[i], spots[j][i]);
    }
    floor.cell = Math.max(high[0] - low[0], high[1] - low[1]) / (SIDE - 2 * (BLUR * TIMES + 1)) || size / SIDE;
    floor.x = (low[0] + high[0] - SIDE * floor.cell) / 2, floor.y = (low[1] + high[1] - SIDE * floor.cell) / 2;
    dark.fill(0);
    for (let f = 0, from = 0; f < facets; f++)
        for (let i = start[f] + 2; i < start[f + 1]; i++, from += 3)
            darken(...[0, 1, 2].map(k => spots[start[f] + D.triangles[from + k]]));
    for (let time = 0; time < TIMES; time++)
        for (let i = 0; i < SIDE; i++) run(i * SIDE, 1), run(i, SIDE);
    for (let i = 0; i < dark.length; i++) pixels[i] = 255 * DARKEST * dark[i] + 0.5;
    return true;
}
function darken(a, b, c) {
    const sign = turn(a, b, c) < 0 ? -1 : 1,
        cell = (v, o) => Math.max(0, Math.min(SIDE - 1, Math.floor((v - o) / floor.cell)));
    const left = cell(Math.min(a[0], b[0], c[0]), floor.x), right = cell(Math.max(a[0], b[0], c[0]), floor.x);
    const top = cell(Math.max(a[1], b[1], c[1]), floor.y), p = [0, 0];
    for (let y = cell(Math.min(a[1], b[1], c[1]), floor.y); y <= top; y++)
        for (let x = left; x <= right; x++) {
            p[0] = floor.x + (x + 0.5) * floor.cell, p[1] = floor.y + (y + 0.5) * floor.cell;
            if (sign * turn(a, b, p) >= 0 && sign * turn(b, c, p) >= 0 && sign * turn(c, a, p) >= 0)
                dark[y * SIDE + x] = 1;
        }
}
function run(first, apart) {
    let sum = 0;
    for (let i = 0; i < SIDE; i++) row[i] = dark[first + i * apart];
    for (let i = 0; i < BLUR; i++) sum += row[i];
    for (let i = 0; i < SIDE; i++) {
        if (i + BLUR < SIDE) sum += row[i + BLUR];
        if (i > BLUR) sum -= row[i - BLUR - 1];
        dark[first + i * apart] = sum / (2 * BLUR + 1);
    }
}

/* ---- drawing by WebGL ---- */

function makeGl(canvas) {
    const gl = canvas.getContext('webgl2', { antialias: true });
    if (!gl) return null;
    const PASS = `in vec3 at, ink, plane; in vec2 range, uv; uniform mat4 M;
        flat out vec3 C, L; flat out vec2 R; out vec2 T;`;
    const FACE = PASS + `void main() { C = ink; L = plane; R = range; T = uv; gl_Position = M * vec4(at, 1.0); }`;
    /* A line is two triangles, widened on the screen; it has the depth of its facet. */
    const LINE = PASS + `in vec3 to; in float side; uniform vec2 half_size;
        void main() { C = ink; L = plane; R = range; T = vec2(-1.0); vec4 a = M * vec4(at, 1.0), b = M * vec4(to, 1.0);
            vec2 d = (b.xy / b.w - a.xy / a.w) * half_size; float l = length(d); d = l > 0.0 ? d / l : vec2(1.0, 0.0);
            gl_Position = a + vec4(vec2(-d.y, d.x) * side / half_size * a.w, 0.0, 0.0); }`;
    /* What has a place in the printed picture has its light for a colour, else its own. */
    const PIXEL = `uniform vec2 origin; uniform float bias; uniform sampler2D print; uniform vec3 paper;
        flat in vec3 C, L; flat in vec2 R; in vec2 T; out vec4 colour;
        void main() { float d = dot(L, vec3(gl_FragCoord.xy - origin, 1.0)); vec4 p = texture(print, T);
            gl_FragDepth = clamp(d, R.x, R.y) - bias;
            colour = vec4(C / 255.0 * (T.x < -0.5 ? vec3(1.0) : mix(paper, p.rgb, p.a)), 1.0); }`;
    const GROUND = `in vec3 at; in vec2 uv; uniform mat4 M; out vec2 T;
        void main() { T = uv; gl_Position = M * vec4(at, 1.0); gl_Position.z = 0.0; }`;
    const SHADOW = `in vec2 T; uniform sampler2D print; out vec4 colour;
        void main() { colour = vec4(0.0, 0.0, 0.0, texture(print, T).r); }`;
    const program = (vertex, pixel) => {
        const p = gl.createProgram();
        [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, pixel]].forEach(([kind, text]) => {
            const s = gl.createShader(kind);
            gl.shaderSource(s, '#version 300 es\nprecision highp float;\n' + text);
            gl.compileShader(s);
            gl.attachShader(p, s);
        });
        gl.linkProgram(p);
        if (!gl.getProgramParameter(p, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(p));
        return p;
    };
    const face = program(FACE, PIXEL), line = program(LINE, PIXEL), ground = program(GROUND, SHADOW),
        buffer = gl.createBuffer();
    const FACE_SIZE = 13, LINE_SIZE = 17;
    const faceData = new Float32Array(FACE_SIZE * D.triangles.length),
        lineData = new Float32Array(6 * LINE_SIZE * allCorners);
    const texture = () => {
        const t = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, t);
        for (const [key, value] of [[gl.TEXTURE_MIN_FILTER, gl.LINEAR], [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
                                    [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE], [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE]])
        gl.texParameteri(gl.TEXTURE_2D, key, value);
        return t;
    };
    const shadow = texture(), print = texture();
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 1, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    if (D.image) {
        const image = new Image();
        image.onload = () => {
            gl.bindTexture(gl.TEXTURE_2D, print);
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, gl.RGBA, gl.UNSIGNED_BYTE, image);
            touch();
        };
        image.src = 'data:image/png;base64,' + D.image;
    }
    gl.depthFunc(gl.LEQUAL);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);

    /* Position, colour, depth, place in the printed picture: what faces and lines have in common. */
    function put(data, to, j, f, c, printed) {
        for (let k = 0; k < 3; k++) {
            data[to + k] = P[3 * j + k];
            data[to + 3 + k] = c[k];
        }
        for (let k = 0; k < 5; k++) data[to + 6 + k] = depth[5 * f + k];
        data[to + 11] = printed ? uv[2 * j] : -1;
        data[to + 12] = printed ? uv[2 * j + 1] : -1;
    }
    function fillFaces() {
        let to = 0, from = 0;
        for (let f = 0; f < shown; f++) {
            const printed = D.image && isFront[f], c = (printed ? lit : shade).subarray(3 * f, 3 * f + 3);
            for (let i = 0; i < 3 * (start[f + 1] - start[f] - 2); i++, to += FACE_SIZE)
                put(faceData, to, start[f] + D.triangles[from++], f, c, printed);
        }
        return to / FACE_SIZE;
    }
    /* Thin where facets are small, gone where lines would be dots; the outline stays. */
    function fillLines(most) {
        let to = 0;
        for (let f = 0; f < shown && D.lines; f++) {
            const half = Math.min(most, SHARE * wide[f]);
            for (let j = start[f]; j < start[f + 1]; j++) {
                const n = j + 1 < start[f + 1] ? j + 1 : start[f], c = inkOf(j, f);
                if (!c || (c !== INK.B && half < 0.2)) continue;
                /* Seen from its end, the line's left is its right. */
                for (const [p, q, way] of [[j, n, 1], [j, n, -1], [n, j, -1], [n, j, -1], [n, j, 1], [j, n, 1]]) {
                    put(lineData, to, p, f, c, false);
                    for (let k = 0; k < 3; k++) lineData[to + 13 + k] = P[3 * q + k];
                    lineData[to + 16] = way * Math.max(half, 0.3);
                    to += LINE_SIZE;
                }
            }
        }
        return to / LINE_SIZE;
    }
    function drawPart(p, data, size, count, M, c, bias, parts) {
        gl.useProgram(p);
        gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
        gl.bufferData(gl.ARRAY_BUFFER, data.subarray(0, size * count), gl.DYNAMIC_DRAW);
        for (const [name, n, offset] of parts) {
            const i = gl.getAttribLocation(p, name);
            if (i < 0) continue;
            gl.enableVertexAttribArray(i);
            gl.vertexAttribPointer(i, n, gl.FLOAT, false, 4 * size, 4 * offset);
        }
        gl.uniformMatrix4fv(gl.getUniformLocation(p, 'M'), false, M);
        gl.uniform2f(gl.getUniformLocation(p, 'half_size'), canvas.width / 2, canvas.height / 2);
        gl.uniform2f(gl.getUniformLocation(p, 'origin'), c.x, c.y);
        gl.uniform1f(gl.getUniformLocation(p, 'bias'), bias);
        gl.uniform3f(gl.getUniformLocation(p, 'paper'), ...D.paper.front.map(v => v / 255));
        gl.drawArrays(gl.TRIANGLES, 0, count);
    }
    function drawShadow(M, c) {
        const l = floor.x, b = floor.y, r = l + SIDE * floor.cell, t = b + SIDE * floor.cell, z = c.ground;
        gl.bindTexture(gl.TEXTURE_2D, shadow);
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
        gl.texImage2D(gl.TEXTURE_2D, 0, gl.R8, SIDE, SIDE, 0, gl.RED, gl.UNSIGNED_BYTE, pixels);
        gl.disable(gl.DEPTH_TEST);
        gl.enable(gl.BLEND);
        const floorData = [l, b, z, 0, 0, r, b, z, 1, 0, r, t, z, 1, 1, l, b, z, 0, 0, r, t, z, 1, 1, l, t, z, 0, 1];
        drawPart(ground, new Float32Array(floorData), 5, 6, M, c, 0,
                 [['at', 3, 0], ['uv', 2, 3]]);
        gl.disable(gl.BLEND);
    }
    const parts = [['at', 3, 0], ['ink', 3, 3], ['plane', 3, 6], ['range', 2, 9], ['uv', 2, 11], ['to', 3, 13],
                   ['side', 1, 16]];
    return (time, ratio, tint) => {
        const c = camera(time, ratio, canvas.width, canvas.height), M = matrix(c);
        look(c, tint);
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        if (cast(c)) drawShadow(M, c);
        gl.enable(gl.DEPTH_TEST);
        gl.bindTexture(gl.TEXTURE_2D, print);
        drawPart(face, faceData, FACE_SIZE, fillFaces(), M, c, 0, parts.slice(0, 5));
        drawPart(line, lineData, LINE_SIZE, fillLines(Math.max(0.5, HALF * c.shorter * D.line_width)), M, c, TIE,
                 parts);
    };
}

