// The view of the cells in a report: triangles with light from the eye, the edges of the box; WebGL without any library.
(() => {
  const source = document.getElementById("meshes"), canvas = document.querySelector("#view canvas");
  if (!source) return;
  const data = JSON.parse(source.textContent), gl = canvas.getContext("webgl", { antialias: true, preserveDrawingBuffer: true });
  if (!gl || !gl.getExtension("OES_element_index_uint") || !gl.getExtension("OES_standard_derivatives")) {
    canvas.parentNode.textContent = "This browser cannot draw the cells: it has no WebGL.";
    return;
  }
  const bytes = text => Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer;
  const low = data.low, high = data.high, middle = low.map((a, k) => (a + high[k]) / 2);
  const size = Math.hypot(...low.map((a, k) => high[k] - a));

  const program = gl.createProgram();
  const shader = (kind, text) => {
    const one = gl.createShader(kind);
    gl.shaderSource(one, text);
    gl.compileShader(one);
    if (!gl.getShaderParameter(one, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(one));
    gl.attachShader(program, one);
  };
  shader(gl.VERTEX_SHADER, `attribute vec3 place; attribute vec3 colour; uniform mat4 view; uniform mat4 lens; varying vec3 seen; varying vec3 shade;
    void main() { vec4 at = view * vec4(place, 1.0); seen = at.xyz; shade = colour; gl_Position = lens * at; }`);
  shader(gl.FRAGMENT_SHADER, `#extension GL_OES_standard_derivatives : enable
    precision highp float; varying vec3 seen; varying vec3 shade; uniform float lit;
    void main() { vec3 n = normalize(cross(dFdx(seen), dFdy(seen))); float c = abs(dot(n, normalize(seen)));
      gl_FragColor = vec4(shade * mix(1.0, 0.35 + 0.65 * c, lit), 1.0); }`);
  gl.linkProgram(program);
  gl.useProgram(program);
  const uniform = name => gl.getUniformLocation(program, name), attribute = name => gl.getAttribLocation(program, name);

  const ramp = [[59, 76, 192], [141, 176, 254], [221, 221, 221], [244, 152, 122], [180, 4, 38]];
  const ofValue = v => {
    const at = v / 255 * (ramp.length - 1), k = Math.min(Math.floor(at), ramp.length - 2), f = at - k;
    return ramp[k].map((c, i) => (c + f * (ramp[k + 1][i] - c)) / 255);
  };
  const ofCell = number => {  // hues as far apart as the golden ratio sets them
    const h = number * 0.618034 % 1, f = k => { const t = (k + h * 6) % 6; return 0.8 - 0.45 * Math.max(0, Math.min(1, Math.min(t, 4 - t))); };
    return [f(5), f(3), f(1)];
  };
  const buffer = (kind, values) => {
    const one = gl.createBuffer();
    gl.bindBuffer(kind, one);
    gl.bufferData(kind, values, gl.STATIC_DRAW);
    return one;
  };
  const edges = (() => {
    if (!data.box) return null;
    const lines = [], half = data.box.map(a => a / 2);
    for (let k = 0; k < 3; ++k)
      for (const a of [-1, 1]) for (const b of [-1, 1]) for (const end of [-1, 1]) {
        const p = [0, 0, 0];
        p[k] = end * half[k], p[(k + 1) % 3] = a * half[(k + 1) % 3], p[(k + 2) % 3] = b * half[(k + 2) % 3];
        lines.push(...p.map((x, i) => (x - middle[i]) / size));
      }
    const grey = new Float32Array(lines.length).fill(0.6);
    return { place: buffer(gl.ARRAY_BUFFER, new Float32Array(lines)), colour: buffer(gl.ARRAY_BUFFER, grey), count: lines.length / 3 };
  })();

  const loaded = new Map();
  const load = number => {
    if (loaded.has(number)) return loaded.get(number);
    const parts = [];
    for (const [name, mesh] of Object.entries(data.frames[number].meshes)) {
      const packed = new Uint16Array(bytes(mesh.points)), places = new Float32Array(packed.length), colours = new Float32Array(packed.length);
      for (let i = 0; i < packed.length; ++i)
        places[i] = (low[i % 3] + packed[i] / 65535 * (high[i % 3] - low[i % 3]) - middle[i % 3]) / size;
      const cells = new Uint32Array(bytes(data.meshes[name].cells)), values = mesh.values && new Uint8Array(bytes(mesh.values));
      for (let n = 0; n < packed.length / 3; ++n) colours.set(values ? ofValue(values[n]) : ofCell(cells[n]), 3 * n);
      let triangles = new Uint32Array(bytes(data.meshes[name].triangles));
      if (mesh.broken) {
        const broken = new Uint8Array(bytes(mesh.broken));
        triangles = triangles.filter((_, i) => !broken[Math.floor(i / 3)]);
      }
      parts.push({ place: buffer(gl.ARRAY_BUFFER, places), colour: buffer(gl.ARRAY_BUFFER, colours),
                   triangles: buffer(gl.ELEMENT_ARRAY_BUFFER, triangles), count: triangles.length });
    }
    loaded.set(number, parts);
    return parts;
  };

  let azimuth = -0.45, elevation = 0.3, distance = 1.6, now = data.frames.length - 1;
  const draw = () => {
    const width = canvas.clientWidth * devicePixelRatio, height = canvas.clientHeight * devicePixelRatio;
    if (canvas.width !== Math.round(width) || canvas.height !== Math.round(height)) canvas.width = width, canvas.height = height;
    gl.viewport(0, 0, canvas.width, canvas.height);
    gl.clearColor(1, 1, 1, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    // Without a turn, x is to the right and z up, as in pictures of the shear plane. The eye looks along `ahead`.
    const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
    const right = [ca, sa, 0], ahead = [-sa * ce, ca * ce, -se], up = [-sa * se, ca * se, ce];
    const m = [];
    for (let k = 0; k < 3; ++k) m.push(right[k], up[k], -ahead[k], 0);
    m.push(0, 0, -distance, 1);
    const near = distance / 50, far = distance + 2, aspect = canvas.width / canvas.height, f = Math.min(1, aspect) / Math.tan(0.35);
    const lens = [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, 2 * far * near / (near - far), 0];
    gl.uniformMatrix4fv(uniform("view"), false, m);
    gl.uniformMatrix4fv(uniform("lens"), false, lens);
    const use = part => {
      for (const name of ["place", "colour"]) {
        gl.bindBuffer(gl.ARRAY_BUFFER, part[name]);
        gl.enableVertexAttribArray(attribute(name));
        gl.vertexAttribPointer(attribute(name), 3, gl.FLOAT, false, 0, 0);
      }
    };
    gl.uniform1f(uniform("lit"), 1);
    for (const part of load(now)) {
      use(part);
      gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, part.triangles);
      gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
    }
    if (edges) {
      gl.uniform1f(uniform("lit"), 0);
      use(edges);
      gl.drawArrays(gl.LINES, 0, edges.count);
    }
    document.getElementById("label").textContent = data.frames[now].label;
  };

  const pointers = new Map();
  canvas.addEventListener("pointerdown", e => { pointers.set(e.pointerId, [e.clientX, e.clientY]); canvas.setPointerCapture(e.pointerId); });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, e => pointers.delete(e.pointerId));
  canvas.addEventListener("pointermove", e => {
    if (!pointers.has(e.pointerId)) return;
    const before = [...pointers.values()], [x, y] = pointers.get(e.pointerId);
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    if (before.length === 1) {
      azimuth -= (e.clientX - x) / 200;
      elevation = Math.max(-1.57, Math.min(1.57, elevation + (e.clientY - y) / 200));
    } else {
      const apart = list => Math.hypot(list[0][0] - list[1][0], list[0][1] - list[1][1]);
      distance = Math.max(0.2, Math.min(6, distance * apart(before) / Math.max(apart([...pointers.values()]), 1)));
    }
    draw();
  });
  canvas.addEventListener("wheel", e => {
    e.preventDefault();
    distance = Math.max(0.2, Math.min(6, distance * Math.exp(e.deltaY / 800)));
    draw();
  }, { passive: false });
  const slider = document.querySelector("#controls input"), button = document.querySelector("#controls button");
  slider.addEventListener("input", () => { now = +slider.value; draw(); });
  let timer = null;
  button.addEventListener("click", () => {
    button.textContent = timer ? "play" : "stop";
    if (timer) { clearInterval(timer); timer = null; return; }
    timer = setInterval(() => { now = (now + 1) % data.frames.length; slider.value = now; draw(); }, 200);
  });
  if (data.frames.length < 2) button.hidden = slider.hidden = true;
  addEventListener("resize", draw);
  draw();
})();
