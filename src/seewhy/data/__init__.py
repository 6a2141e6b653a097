"""Tables of annotated pictures, and pictures that a domain's source makes."""
