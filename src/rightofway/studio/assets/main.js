/** The studio: files at the left, the map in the middle, planning and runs at the right. */

import { html, render, useCallback, useEffect, useRef, useState } from "./vendor/htm-preact.js";
import { address, get, inAddress, listen, post, put, remove, upload } from "./api.js";
import { Curve } from "./curve.js";
import { Stage } from "./stage.js";
import { words } from "./words.js";

const isOver = (run) => !["queued", "running"].includes(run.state);

function App() {
  const [files, setFiles] = useState([]);
  const [opened, setOpened] = useState(null);
  const [planners, setPlanners] = useState({ default: "auto", planners: [] });
  const [runs, setRuns] = useState([]);
  const [shown, setShown] = useState(null); // the number of the run that is played
  const [payload, setPayload] = useState(null);
  const [faults, setFaults] = useState([]);

  /** Do something that the server may refuse, and show why. */
  const attempt = useCallback(async (action) => {
    try {
      await action();
    } catch (refusal) {
      setFaults(refusal.faults?.length ? refusal.faults : [{ place: "", message: refusal.message }]);
    }
  }, []);

  const listFiles = () => attempt(async () => setFiles((await get("/files")).files));
  const keep = (run) => setRuns((known) => [run, ...known.filter(({ number }) => number !== run.number)].sort((a, b) => b.number - a.number));

  const open = (path) => attempt(async () => {
    setFaults([]);
    const found = await get(`/documents/${inAddress(path)}`);
    if (found.run) {
      keep(found.run);
      await play(found.run.number);
      return;
    }
    setOpened(found);
    setShown(null);
    const { document, folder } = found;
    const verdict = await post("/validate", { document, folder });
    setFaults(verdict.faults);
    if (verdict.ok) setPayload(await post("/draw", { document, folder }));
  });

  const play = (number) => attempt(async () => {
    setShown(number);
    setPayload(await get(`/runs/${number}/payload`));
  });

  const watch = (number) => listen(number, {
    run(run) {
      keep(run);
      if (isOver(run) && run.has_plan) play(run.number);
      if (run.error) setFaults(run.error.faults?.length ? run.error.faults : [{ place: "", message: run.error.message }]);
    },
    progress({ seconds, flowtime }) {
      if (flowtime === undefined) return;
      setRuns((known) => known.map((run) => (run.number === number ? { ...run, points: [...run.points, [seconds, flowtime]] } : run)));
    },
    plan({ figures }) {
      setRuns((known) => known.map((run) => (run.number === number ? { ...run, figures, has_plan: true } : run)));
      play(number);
    },
  });

  const plan = (settings) => attempt(async () => {
    setFaults([]);
    const { document, folder, path: source } = opened;
    const run = await post("/runs", { kind: "plan", document, folder, source, ...settings });
    keep(run);
    watch(run.number);
  });

  const drop = (event) => {
    event.preventDefault();
    const [file] = event.dataTransfer.files;
    if (file) attempt(async () => {
      const { path } = await upload(file);
      await listFiles();
      await open(path);
    });
  };

  const save = () => attempt(async () => {
    const { path, document, folder, revision } = opened;
    setOpened({ ...opened, ...(await put(`/documents/${inAddress(path)}`, { document, folder, revision })) });
  });

  useEffect(() => {
    attempt(async () => {
      const [about, found, known] = await Promise.all([get("/"), get("/planners"), get("/runs")]);
      setPlanners(found);
      setRuns(known.runs);
      for (const run of known.runs) if (!isOver(run)) watch(run.number);
      await listFiles();
      if (about.file) await open(about.file);
    });
  }, []);

  const running = runs.find((run) => !isOver(run));
  const current = runs.find(({ number }) => number === (running?.number ?? shown));
  return html`
    <div class="files" onDragOver=${(event) => event.preventDefault()} onDrop=${drop}>
      <h1>rightofway</h1>
      <h2>${words.files}</h2>
      <ul>${files.map(({ path }) => html`
        <li><button class=${opened?.path === path ? "chosen" : ""} onClick=${() => open(path)}>${path}</button></li>`)}
      </ul>
      <p class="hint">${words.drop}</p>
    </div>
    <${Map} payload=${payload} playing=${shown !== null} />
    <div class="planning">
      ${opened ? html`<${Settings} planners=${planners} running=${running} plan=${plan} save=${save} attempt=${attempt} />`
        : html`<p class="hint">${words.noFile}</p>`}
      ${faults.length > 0 && html`<section class="wrong" role="alert"><h2>${words.faults}</h2>
        <ul>${faults.map(({ place, named, message }) => html`<li>${named || place ? html`<b>${named || place}</b> ` : ""}${message}</li>`)}</ul>
      </section>`}
      ${current && html`<${Curve} run=${current} />`}
      <h2>${words.runs}</h2>
      <ul class="runs">${runs.map((run) => html`
        <li class=${run.number === shown ? "chosen" : ""}>
          <button disabled=${!run.has_plan} onClick=${() => play(run.number)}>
            <b>${run.name || run.source || run.kind} ${run.number}</b> ${words[run.state]}
            ${run.figures && html` <span>${run.figures.text.flowtime}</span>`}
          </button>
          ${run.has_plan && html`<a href=${address(`/runs/${run.number}/page`)} target="_blank" rel="noopener">${words.page}</a>`}
          ${isOver(run) && html`<button class="quiet" onClick=${() => attempt(async () => {
            await remove(`/runs/${run.number}`);
            setRuns((known) => known.filter(({ number }) => number !== run.number));
          })}>${words.remove}</button>`}
        </li>`)}
      </ul>
    </div>`;
}

/** Planner, time limit, and the buttons that begin and end a run. */
function Settings({ planners, running, plan, save, attempt }) {
  const [planner, setPlanner] = useState("");
  const [limit, setLimit] = useState(10);
  const chosen = planner || planners.default;
  return html`
    <form class="settings" onSubmit=${(event) => {
      event.preventDefault();
      plan({ planner: chosen, time_limit: Number(limit) });
    }}>
      <label>${words.planner}
        <select value=${chosen} onChange=${(event) => setPlanner(event.target.value)}>
          ${planners.planners.map(({ name, summary }) => html`<option value=${name} title=${summary}>${name}</option>`)}
        </select></label>
      <label>${words.limit}
        <input type="number" min="0.1" max="3600" step="any" value=${limit} onInput=${(event) => setLimit(event.target.value)} /></label>
      <div class="buttons">
        <button class="main" type="submit" disabled=${Boolean(running)}>${words.plan}</button>
        ${running && html`<button type="button" onClick=${() => attempt(() => post(`/runs/${running.number}/stop`))}>${words.stop}</button>`}
        <button type="button" onClick=${save}>${words.save}</button>
      </div>
    </form>`;
}

/** The map, with a button that plays. */
function Map({ payload, playing }) {
  const [holder, stage] = [useRef(null), useRef(null)];
  useEffect(() => {
    stage.current = new Stage(holder.current);
    window.stage = stage.current; // for tests
  }, []);
  useEffect(() => {
    if (!payload) return;
    stage.current.show(payload);
    if (playing && stage.current.clock.tick === 0 && !matchMedia("(prefers-reduced-motion: reduce)").matches) stage.current.clock.play();
  }, [payload]);
  return html`
    <section class="map" aria-label=${words.map}>
      <div class="holder" ref=${holder}></div>
      ${playing && html`<button class="play" onClick=${() => stage.current.clock.toggle()}>${words.play}</button>`}
    </section>`;
}

render(html`<${App} />`, document.body);
