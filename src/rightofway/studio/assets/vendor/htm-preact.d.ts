/** Types of what the vendored file exports: Preact's own, and templates whose handlers know what they get. */

import type { ComponentChild, VNode } from "preact";

export type { ComponentChildren } from "preact";

export {
  Component,
  createContext,
  h,
  render,
} from "preact";
export { useEffect, useReducer, useState } from "preact/hooks";

/** An event of the page; what is read of it depends on its kind. */
export type PageEvent = KeyboardEvent &
  PointerEvent &
  ClipboardEvent &
  ToggleEvent & { target: HTMLInputElement; currentTarget: HTMLElement };

/** What stands in a template: a text, an element, an attribute, a component, what hears of an event. */
type Value = ((event: PageEvent) => unknown) | ComponentChild | object;

export function html(strings: TemplateStringsArray, ...values: Value[]): VNode;

/** The element that a template gives to a `ref`; it is read only after the page is drawn. */
export interface Ref<T> {
  current: T;
}
export function useRef<T = HTMLElement>(initial: null): Ref<T>;
export function useRef<T>(initial: T): Ref<T>;
