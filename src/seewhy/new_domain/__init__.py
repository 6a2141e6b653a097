"""Write a domain folder to start from: the template, or what pictures and their labels say."""
