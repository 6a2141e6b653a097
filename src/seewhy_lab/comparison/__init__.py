"""SeeWhy beside what else one would try, on the same held-out pictures: ``commands/compare.py``.

An experiment of :mod:`seewhy_lab.experiments` is a claim of the paper about one domain. This asks
how good five systems are on five sets, three of which are archives that come with no wheel, two of
these with domains of their own. What both need is taken from there: claims of work, origins of
trials.

======================  ==========================================================
``picture_sets.py``     the sets, and which of their pictures are tested on
``system.py``           what a system is given, and what comes of it
``seewhy_agents.py``    (a) SeeWhy by default, (e) SeeWhy with networks that grow
``small_network.py``    (b) a small network end to end
``frozen_features.py``  (c) the backbone as it is, and logistic regression
``fine_tuned.py``       (d) the whole backbone, tuned
``variations.py``       how pictures are varied, the same for all who vary them
``catalogue.py``        the five by name
``trials.py``           one file a trial; those that are missing are run
``page.py``             the page over all trials that there are
======================  ==========================================================
"""
