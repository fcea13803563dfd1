// The page of a render that goes on: asks where it stands twice a second, and for the picture that is looked at when it is new.

const POLL = 500, PATIENCE = 3;  // milliseconds; polls in a row without an answer, then the program is taken for gone
const VIEWER_NAME = Array.from(crypto.getRandomValues(new Uint8Array(8)), (b) => b.toString(16).padStart(2, '0')).join('');

function duration(seconds) {
  const s = Math.round(seconds), two = (n) => String(n).padStart(2, '0');
  return s < 3600 ? `${Math.floor(s / 60)}:${two(s % 60)}` :
                    `${Math.floor(s / 3600)}:${two(Math.floor(s / 60) % 60)}:${two(s % 60)}`;
}

function statusText(state) {
  if (state.stage === 'ended') return state.outcome;
  const doing = state.cancelled ? 'stopping' : state.preparing ? 'looking at the film' : state.stage;
  if (state.stage !== 'rendering') return doing;
  const left = state.remaining > 0 ? duration(state.remaining) : '?', next = state.next ? `, then ${state.next}` : '';
  return `${doing}, ${state.samples} samples a pixel, ${duration(state.seconds)} done, ${left} left${next}`;
}

/** Asks once more before it cancels. */
function cancelButtons() {
  const ask = element('button', {type: 'button', class: 'cancel', onclick: () => choose(true)}, 'Cancel');
  const stop =
      element('button', {type: 'button', class: 'stop bad', onclick: () => cancelRender()}, 'Stop and write the image');
  const keep = element('button', {type: 'button', class: 'keep', onclick: () => choose(false)}, 'Go on');
  const refused = element(
      'p', {class: 'subtitle bad', role: 'alert', hidden: true},
      'The program did not take it. If it was started after this page was opened, load the page again and then cancel.');
  const choose = (sure) => {
    ask.hidden = sure;
    stop.hidden = keep.hidden = !sure;
    if (sure) keep.focus();
  };
  const cancelRender = () => {
    group.hidden = refused.hidden = true;
    fetch('cancel', {method: 'POST', headers: {'X-Tyndall-Token': RESULTS.token}})
        .then((answer) => answer.ok, () => false)
        .then((ok) => {
          group.hidden = ok;
          refused.hidden = ok;
          choose(false);
        });
  };
  const group = element('div', {class: 'cancel-buttons'}, ask, stop, keep, refused);
  choose(false);
  return group;
}

class LivePage {
  constructor() {
    this.viewer = null;
    this.version = 0;  // shown
    this.missed = 0;
    this.status = element('p', {class: 'headline', role: 'status'}, 'asking');
    this.error = element('p', {class: 'subtitle'});
    this.bar = element('progress', {max: 1, value: 0, 'aria-label': 'Share of the render that is done'});
    this.title = element('h1', {}, RESULTS.title);
    this.cancel = cancelButtons();
    this.place = element('section', {'aria-label': 'Picture'}, element('p', {class: 'note'}, 'There is no picture yet.'));
    this.root = element(
        'div', {class: 'live'},
        element('header', {}, element('div', {class: 'brand'}, 'Tyndall render', themeSwitch()), this.title),
        element('div', {class: 'live-state'}, element('div', {}, this.status, this.error), this.cancel), this.bar, this.place);
  }

  async poll() {
    let state = null;
    try {
      const answer = await fetch(`state/${VIEWER_NAME}/${this.version}`);
      if (answer.ok) state = await answer.json();
    } catch { /* as no answer */
    }
    this.missed = state ? 0 : this.missed + 1;
    if (state) await this.take(state);
    const complete = this.ended && this.version === this.latest;
    if (complete) return fetch(`state/${VIEWER_NAME}/${this.version}`).catch(() => {});  // so that the program waits no longer
    if (this.missed < PATIENCE) return setTimeout(() => this.poll(), this.ended ? 50 : POLL);
    if (!this.ended) this.lose();
  }

  async take(state) {
    this.ended = state.stage === 'ended';
    this.tell(state);
    if (state.version === this.latest) return this.showing();
    this.latest = state.version;
    if (!state.pictures.length) return this.showing();
    this.fit(state.pictures);
    state.pictures.forEach((_, i) => this.viewer.pictures[i].renew(`picture/${state.version}/${i}`));
    this.viewer.update();
    return this.showing();
  }

  /** Notes the version as shown when what is looked at is there, at the end when all is. */
  async showing() {
    const wanted = !this.viewer ? [] : this.ended ? this.viewer.pictures : this.viewer.needed();
    const version = this.latest, loaded = await Promise.all(wanted.map((picture) => picture.load()));
    if (loaded.every(Boolean) && version === this.latest) this.version = version;
    this.root.dataset.version = this.version;
  }

  /** A viewer for these pictures: the one there is, or a new one that goes on where it was. */
  fit(pictures) {
    const key = JSON.stringify(pictures), before = this.viewer;
    if (key === this.key) return;
    this.key = key;
    const live = pictures.map((picture) => new LivePicture(picture));
    this.viewer = activeViewer = new Viewer(live, 0.01);
    for (const picture of live) {
      picture.changed = () => {
        this.viewer.cache.delete(picture);
        this.viewer.update();
      };
    }
    if (before) this.goOnFrom(before);
    this.place.replaceChildren(this.viewer.root);
  }

  goOnFrom(before) {
    const {viewer} = this, like = (picture) => viewer.pictures.find((p) => p.isLike(picture)) ?? viewer.current;
    for (const old of before.pictures) {
      if (like(old).isLike(old)) like(old).halves = old.halves;
    }
    if (viewer.current.isOfSize(before.current)) Object.assign(viewer.view, before.view);
    const {mode, stops, wipe} = before;
    viewer.set({mode, stops, wipe, current: like(before.current), other: like(before.other)});
  }

  tell(state) {
    this.root.dataset.stage = state.stage;
    this.title.textContent = state.output || RESULTS.title;
    this.status.textContent = statusText(state);
    this.error.textContent = `estimated relMSE of the picture shown: ${formatNumber(state.relmse)}`;
    this.error.hidden = !state.pictures.length;
    this.bar.value = this.ended ? 1 : state.fraction;
    this.bar.hidden = this.ended;
    if (state.cancelled || this.ended) this.cancel.hidden = true;
    document.title = `${this.ended ? '' : `${Math.round(100 * state.fraction)} % `}${RESULTS.title}`;
  }

  lose() {
    this.root.dataset.stage = 'lost';
    this.status.textContent = 'The program does not answer any more. What is shown is the last picture that came from it.';
    this.status.classList.add('bad');
    this.cancel.hidden = this.bar.hidden = true;
  }
}

const live = new LivePage();
document.getElementById('page').append(live.root);
live.poll();
