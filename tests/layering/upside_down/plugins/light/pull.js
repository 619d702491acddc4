export const pull = 9.81;
