//! Faces with an opacity of their own: what of them lies in front of the opaque envelope.

use crate::segment::Segment;

/// The parts of `veils` that lie in front of `visible`, sorted by their left ends. `visible` does not
/// overlap and is sorted; `veils` are in any order, and so may overlap.
pub(crate) fn in_front(veils: &[Segment], visible: &[Segment], out: &mut Vec<Segment>) {
    out.clear();
    for veil in veils {
        let mut x = veil.x0;
        let mut first = visible.partition_point(|span| span.x1 <= veil.x0);
        while x < veil.x1 {
            let Some(span) = visible.get(first).filter(|span| span.x0 < veil.x1) else {
                push(out, veil, x, veil.x1);
                break;
            };
            push(out, veil, x, span.x0);
            let (l, r) = (x.max(span.x0), veil.x1.min(span.x1));
            over(veil, span, l, r, out);
            x = r;
            first += 1;
        }
    }
    crate::envelope::sort(out);
}

/// The part of `veil` on \[l, r\] that is in front of `span`; one that lies in it (a poster on a wall)
/// counts as in front.
fn over(veil: &Segment, span: &Segment, l: f64, r: f64, out: &mut Vec<Segment>) {
    let error = f64::from(veil.error) + f64::from(span.error);
    let at_l = veil.nearness(l) - span.nearness(l) + error;
    let at_r = veil.nearness(r) - span.nearness(r) + error;
    let x = l + (r - l) * (at_l / (at_l - at_r));
    match (at_l >= 0.0, at_r >= 0.0) {
        (true, true) => push(out, veil, l, r),
        (true, false) => push(out, veil, l, x.clamp(l, r)),
        (false, true) => push(out, veil, x.clamp(l, r), r),
        (false, false) => {}
    }
}

fn push(out: &mut Vec<Segment>, veil: &Segment, x0: f64, x1: f64) {
    if x0 >= x1 {
        return;
    }
    // The part before an unbroken boundary between two opaque spans goes on.
    if let Some(last) = out.last_mut()
        && last.face == veil.face
        && last.x1 == x0
        && last.slope == veil.slope
    {
        last.x1 = x1;
        return;
    }
    out.push(Segment { x0, x1, w: veil.nearness(x0), ..*veil });
}
