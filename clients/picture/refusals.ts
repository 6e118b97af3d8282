// What can be asked of the user where a program is refused, by the server's sentence in either language. Knows nothing of VS Code.

/** Which side of a contour the wire runs on is not known. */
export const SIDE_IS_NOT_KNOWN = /side of contour .* is not known|不知道轮廓 .*的补偿方向/;
/** Nothing says what the parts of a pair are, or how far apart. */
export const PAIR_IS_NOT_SET = /corrections of a pair are not known|不知道这一对零件的补偿量/;
