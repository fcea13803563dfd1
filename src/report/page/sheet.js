// All pictures side by side: the overview on the screen, and what print shows instead of the viewer.

/** Calls work() for one item after another, when the browser is idle or has been busy for long. */
async function whenIdle(items, work) {
  for (const item of items) {
    await new Promise(
        (resolve) => (window.requestIdleCallback ? requestIdleCallback(resolve, {timeout: 200}) : setTimeout(resolve)));
    await work(item);
  }
}

/** Half the size of a large picture is enough for an overview. */
const sheetScale = (picture) => Math.min(1, Math.max(480, picture.width / 2) / picture.width);

class Sheet {
  /**
   * `caption(picture)` gives what stands below a picture; a click shows it in the viewer. `errors`: pictures whose error maps
   * follow.
   */
  constructor(viewer, caption, errors = []) {
    this.viewer = viewer;
    const shown = [...viewer.pictures.map((picture) => [picture, 'picture']), ...errors.map((picture) => [picture, 'error'])];
    this.cards = shown.map(([picture, mode]) => {
      const scale = sheetScale(picture), size = {width: Math.round(picture.width * scale), height: Math.round(picture.height * scale)};
      const canvas = element('canvas', {...size, class: picture.width < 200 ? 'small' : null});
      const show = () => {
        viewer.set({current: picture, mode});
        viewer.root.scrollIntoView({block: 'nearest', behavior: 'smooth'});
      };
      const card = element(
          'figure', {},
          element('button', {type: 'button', onclick: show, 'aria-label': `Show the ${mode} ${picture.name}`}, canvas),
          element('figcaption', {}, mode === 'error' ? `error of ${picture.name}` : caption(picture)));
      return {picture, mode, canvas, card};
    });
    this.root = element('div', {class: 'sheet'}, this.cards.map(({card}) => card));
    viewer.listeners.push(() => this.follow());
    this.follow();
  }

  /** At the exposure of the viewer, a moment after it has come to rest. */
  follow() {
    if (this.stops === this.viewer.stops) return;
    this.stops = this.viewer.stops;
    clearTimeout(this.timer);
    this.timer = setTimeout(() => this.draw(this.stops), 250);
  }

  draw(stops) {
    const table = toneTable(stops);
    return whenIdle(this.cards, async ({picture, mode, canvas}) => {
      if (stops !== this.stops) return;
      const {reference, eps} = this.viewer;
      await Promise.all([picture.load(), mode === 'error' ? reference.load() : null]);
      const painted = picture.kind !== 'light' ? dataMap(picture) : mode === 'error' ? errorMap(picture, reference, eps) : toned(picture, table);
      canvas.getContext('2d').drawImage(painted, 0, 0, canvas.width, canvas.height);
    });
  }
}
