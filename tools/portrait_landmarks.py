"""Find the face in the bundled portrait anew: ``python tools/portrait_landmarks.py``.

Needs the extra ``photo`` and MediaPipe's model (docs/photos.md).
"""

from __future__ import annotations

from pdeface.photo import find_faces
from pdeface.photo.bundled import DATA, write_face
from pdeface.texture import portrait

if __name__ == "__main__":
    write_face(find_faces(portrait()[0])[0], DATA)
    print(f"wrote {DATA}")
