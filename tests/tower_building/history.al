% The ball lies on a large box at first.
observed on(b5, b3) at 0.
