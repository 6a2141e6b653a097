#sort structure.
#sort num = 1..5.
#sort width = {wide, narrow}.
#static num_blocks(structure, num).
#static base(structure, width).
#static lean(structure).
#static block_displaced(structure).
#static stable(structure).

%% a block that is not balanced on the one below it falls
-stable(S) if block_displaced(S).

%% a single block that stands upright stays where it is
stable(S) if num_blocks(S, 1), not lean(S).

%% two blocks that do not lean stay where they are
stable(S) if num_blocks(S, 2), not lean(S).

%% three blocks that do not lean stay where they are when each is balanced on the one below it
stable(S) if num_blocks(S, 3), not lean(S), not block_displaced(S).

%% a structure on a wide base does not fall when it stands straight and every block is balanced
stable(S) if base(S, wide), not lean(S), not block_displaced(S).

%% a single block that is set down on one of its edges drops
-stable(S) if num_blocks(S, 1), lean(S).

%% a leaning structure of more than three blocks on a narrow base topples
-stable(S) if lean(S), base(S, narrow), num_blocks(S, N), N > 3.

%% a wide base carries a low leaning structure when every block is balanced
stable(S) if lean(S), base(S, wide), num_blocks(S, N), N > 1, N < 4, not block_displaced(S).
