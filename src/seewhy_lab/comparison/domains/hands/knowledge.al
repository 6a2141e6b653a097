% The signature: sorts, and statics over them. 'hand' is the picture at hand.
#sort hand.
#sort kind = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}.
#sort thumb_value = {folded, stretched}.
#sort index_value = {folded, stretched}.
#sort middle_value = {folded, stretched}.
#sort ring_value = {folded, stretched}.
#sort little_value = {folded, stretched}.
#static thumb(hand, thumb_value).
#static index(hand, index_value).
#static middle(hand, middle_value).
#static ring(hand, ring_value).
#static little(hand, little_value).
#static of_kind(hand, kind).

% A digit is known by all five fingers.

%% a hand with every finger folded is a zero
of_kind(S, 0) if thumb(S, folded), index(S, folded), middle(S, folded), ring(S, folded), little(S, folded).

%% a hand that stretches only the index finger is a one
of_kind(S, 1) if thumb(S, folded), index(S, stretched), middle(S, folded), ring(S, folded), little(S, folded).

%% a hand that stretches only the index finger and the middle finger is a two
of_kind(S, 2) if thumb(S, folded), index(S, stretched), middle(S, stretched), ring(S, folded), little(S, folded).

%% a hand that stretches only the thumb, the index finger and the middle finger is a three
of_kind(S, 3) if thumb(S, stretched), index(S, stretched), middle(S, stretched), ring(S, folded), little(S, folded).

%% a hand that folds only the thumb is a four
of_kind(S, 4) if thumb(S, folded), index(S, stretched), middle(S, stretched), ring(S, stretched), little(S, stretched).

%% a hand with every finger stretched is a five
of_kind(S, 5) if thumb(S, stretched), index(S, stretched), middle(S, stretched), ring(S, stretched), little(S, stretched).

%% a hand that stretches only the index finger, the middle finger and the ring finger is a six
of_kind(S, 6) if thumb(S, folded), index(S, stretched), middle(S, stretched), ring(S, stretched), little(S, folded).

%% a hand that stretches only the index finger, the middle finger and the little finger is a seven
of_kind(S, 7) if thumb(S, folded), index(S, stretched), middle(S, stretched), ring(S, folded), little(S, stretched).

%% a hand that stretches only the index finger, the ring finger and the little finger is an eight
of_kind(S, 8) if thumb(S, folded), index(S, stretched), middle(S, folded), ring(S, stretched), little(S, stretched).

%% a hand that stretches only the middle finger, the ring finger and the little finger is a nine
of_kind(S, 9) if thumb(S, folded), index(S, folded), middle(S, stretched), ring(S, stretched), little(S, stretched).
