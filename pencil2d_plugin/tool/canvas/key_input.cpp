#include "tool/canvas/key_input.h"

#include "scene/timeline.h"

#include <QApplication>
#include <QLineEdit>
#include <QTextEdit>

namespace lampblack
{

namespace
{

constexpr int CompareKey = Qt::Key_D;
constexpr double LargeStep = 10;

bool isArrow(int key)
{
    return key == Qt::Key_Left || key == Qt::Key_Right || key == Qt::Key_Up || key == Qt::Key_Down;
}

bool isDelete(int key)
{
    return key == Qt::Key_Delete || key == Qt::Key_Backspace;
}

} // namespace

KeyInput::KeyInput(Host& host, SceneDocument& document, CanvasOverlay& overlay, CanvasInput& input,
                   CutEditor* cuts, BrushEditor* brush)
    : QObject(&overlay), mHost(host), mDocument(document), mOverlay(overlay), mInput(input), mCuts(cuts),
      mBrush(brush)
{
}

KeyInput::~KeyInput()
{
    setListening(false);
}

void KeyInput::setListening(bool listening)
{
    if (listening == mListening)
        return;
    mListening = listening;
    if (listening)
    {
        qApp->installEventFilter(this);
        return;
    }
    qApp->removeEventFilter(this);
    setComparing(false);
}

bool KeyInput::eventFilter(QObject* watched, QEvent* event)
{
    const QEvent::Type type = event->type();
    if (type == QEvent::WindowDeactivate && watched == mHost.window())
        setComparing(false); // the key may be released elsewhere
    if (type != QEvent::ShortcutOverride && type != QEvent::KeyPress && type != QEvent::KeyRelease)
        return false;
    if (!watched->isWidgetType()) // a QWindow passes the event on to its widgets
        return false;
    const auto& key = static_cast<QKeyEvent&>(*event);
    if (type == QEvent::KeyRelease)
    {
        if (!mComparing || key.key() != CompareKey)
            return false;
        if (!key.isAutoRepeat())
            setComparing(false);
        return true;
    }
    if (!isOurs(key))
        return false;
    event->accept();
    return type == QEvent::ShortcutOverride || handleKey(key);
}

bool KeyInput::isOurs(const QKeyEvent& key) const
{
    if (QApplication::activePopupWidget() || QApplication::activeModalWidget())
        return false;
    // Other text fields have an undo of their own.
    QWidget* focus = QApplication::focusWidget();
    const bool isOtherText = (qobject_cast<QLineEdit*>(focus) || qobject_cast<QTextEdit*>(focus)) &&
                             !focus->property("lampblack.value").toBool();
    if (!isOtherText && mHost.can(Host::Ability::Undo))
    {
        const QUndoStack& stack = *mDocument.undoStack();
        if (key.matches(QKeySequence::Undo))
            return stack.canUndo();
        if (key.matches(QKeySequence::Redo))
            return stack.canRedo();
    }
    if (key.key() == Qt::Key_Escape)
        return mInput.isDragging() || mInput.isPicking() || (editsCuts() && mCuts->isDrawing()) ||
               (usesBrush() && mBrush->isDrawing());
    const Qt::KeyboardModifiers modifiers = key.modifiers() & ~Qt::KeypadModifier;
    // Our fields take numbers only, so the key is free wherever no text is written.
    if (key.key() == CompareKey && modifiers == Qt::NoModifier)
        return !isOtherText && (focus == nullptr || focus->window() == mHost.window());
    if (!focusIsOnCanvas())
        return false;
    if (usesBrush())
        return isDelete(key.key()) && modifiers == Qt::NoModifier && mBrush->hovered() >= 0;
    if (editsCuts())
        return isDelete(key.key()) && modifiers == Qt::NoModifier && mCuts->hovered() != nullptr &&
               mCuts->hovered()->hint >= 0;
    if (mDocument.selectedLight() < 0)
        return false;
    return (isDelete(key.key()) && modifiers == Qt::NoModifier) ||
           (isArrow(key.key()) && !(modifiers & ~Qt::ShiftModifier));
}

bool KeyInput::handleKey(const QKeyEvent& key)
{
    if (key.matches(QKeySequence::Undo) || key.matches(QKeySequence::Redo))
    {
        cancelDrag();
        if (key.matches(QKeySequence::Undo))
            mDocument.undoStack()->undo();
        else
            mDocument.undoStack()->redo();
    }
    else if (key.key() == Qt::Key_Escape)
    {
        cancelDrag();
        mInput.setPicking(false);
    }
    else if (key.key() == CompareKey)
    {
        setComparing(true);
    }
    else if (usesBrush())
    {
        mBrush->removeStroke(mBrush->hovered());
    }
    else if (editsCuts())
    {
        mCuts->removeCorrection(*mCuts->hovered());
    }
    else if (isDelete(key.key()))
    {
        mInput.cancelDrag();
        mDocument.edit(tr("Delete Light"), withoutLight(mDocument.scene(), mDocument.selectedLight()));
    }
    else
    {
        nudge(key);
    }
    return true;
}

void KeyInput::cancelDrag()
{
    mInput.cancelDrag();
    if (mCuts != nullptr)
        mCuts->cancelStroke();
    if (mBrush != nullptr)
        mBrush->cancelStroke();
}

bool KeyInput::focusIsOnCanvas() const
{
    const QWidget* focus = QApplication::focusWidget();
    return !focus || focus == mHost.canvas() || focus == mHost.window();
}

void KeyInput::nudge(const QKeyEvent& key)
{
    Scene scene = mDocument.scene();
    const int selected = mDocument.selectedLight();
    if (selected >= scene.lights.size() || !mOverlay.canvasToWidget())
        return;
    const double step = key.modifiers().testFlag(Qt::ShiftModifier) ? LargeStep : 1;
    QPointF by;
    by.setX(key.key() == Qt::Key_Left ? -step : key.key() == Qt::Key_Right ? step : 0);
    by.setY(key.key() == Qt::Key_Up ? -step : key.key() == Qt::Key_Down ? step : 0);
    // The direction is that on the screen, however the canvas is turned; the length is in canvas pixels.
    const QTransform toCanvas = mOverlay.canvasToWidget()->inverted();
    by = (toCanvas.map(by) - toCanvas.map(QPointF())) / scaleOf(toCanvas);
    const int frame = mHost.currentFrame();
    AreaLight light = lightAt(scene.lights[selected], frame);
    light.x += by.x();
    light.y += by.y();
    scene.lights[selected] = changedAt(scene.lights[selected], frame, light);
    mDocument.edit(tr("Nudge Light"), scene,
                   mNudgeGestures.gestureFor(QStringLiteral("%1 %2").arg(selected).arg(frame)));
}

void KeyInput::setComparing(bool comparing)
{
    if (comparing == mComparing)
        return;
    mComparing = comparing;
    mOverlay.setComparing(comparing);
    Q_EMIT comparingChanged(comparing);
}

Scene withoutLight(Scene scene, int light)
{
    if (light >= 0 && light < scene.lights.size())
        scene.lights.remove(light);
    return scene;
}

} // namespace lampblack
