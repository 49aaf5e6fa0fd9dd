export function createView(element, data) {}
