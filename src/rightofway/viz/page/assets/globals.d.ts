// What the frame of the notebook has, see viz/page/widget.py: the markup, and all scripts of the page.
declare const MARKUP: string;
declare function mount(document: object): { clock: { pause(): void } };
