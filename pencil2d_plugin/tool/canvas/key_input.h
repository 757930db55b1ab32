// Keyboard input while the lamp is in use.
#pragma once

#include "host/host.h"
#include "scene/scene_document.h"
#include "tool/canvas/canvas_input.h"
#include "tool/depth/brush_editor.h"
#include "tool/depth/cut_editor.h"
#include "tool/gesture.h"

#include <QKeyEvent>
#include <QObject>

namespace lampblack
{

/// Undo and redo change the scene first, wherever the focus is. Holding D shows the drawing as drawn, unless
/// the focus is where text is written. With the focus on the canvas, arrow keys nudge the selected light,
/// Delete removes it, and Escape cancels a drag. While cuts are edited or the brush is used, Delete removes
/// the correction under the pointer instead. It is an event filter of the application while it listens.
class KeyInput : public QObject
{
    Q_OBJECT

public:
    KeyInput(Host& host, SceneDocument& document, CanvasOverlay& overlay, CanvasInput& input,
             CutEditor* cuts = nullptr, BrushEditor* brush = nullptr);
    ~KeyInput() override;

    void setListening(bool listening);

Q_SIGNALS:
    void comparingChanged(bool comparing);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    bool isOurs(const QKeyEvent& key) const;
    bool handleKey(const QKeyEvent& key);
    bool focusIsOnCanvas() const;
    bool editsCuts() const { return mCuts != nullptr && mCuts->isListening(); }
    bool usesBrush() const { return mBrush != nullptr && mBrush->isListening(); }
    void cancelDrag();
    void nudge(const QKeyEvent& key);
    void setComparing(bool comparing);

    Host& mHost;
    SceneDocument& mDocument;
    CanvasOverlay& mOverlay;
    CanvasInput& mInput;
    CutEditor* mCuts; ///< or null, as the next
    BrushEditor* mBrush;
    GestureSequence mNudgeGestures;
    bool mListening = false;
    bool mComparing = false;
};

/// `scene` without one of its lights.
Scene withoutLight(Scene scene, int light);

} // namespace lampblack
