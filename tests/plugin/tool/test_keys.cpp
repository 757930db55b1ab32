// Keys: undo goes to the scene first, and to the drawing program once the scene has nothing left.
#include "support/fake_host.h"
#include "support/mouse.h"
#include "support/scenes.h"
#include "tool/canvas/canvas_input.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/canvas/key_input.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>

#include <memory>

using namespace lampblack;

class KeysTest : public QObject
{
    Q_OBJECT

private:
    std::unique_ptr<FakeHost> mHost;
    std::unique_ptr<SceneDocument> mDocument;
    CanvasOverlay* mOverlay = nullptr;
    CanvasInput* mInput = nullptr;
    KeyInput* mKeys = nullptr;
    int mHostUndone = 0;

    const AreaLight& light() const { return mDocument->scene().lights[0]; }
    void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
    {
        QTest::keyClick(mHost->mCanvas, key, modifiers);
    }

private Q_SLOTS:
    void init()
    {
        mHost = std::make_unique<FakeHost>();
        mDocument = std::make_unique<SceneDocument>();
        mDocument->reset(sceneWithLight(200, 150, 200));
        mOverlay = new CanvasOverlay(*mHost, *mDocument);
        mInput = new CanvasInput(*mHost, *mDocument, *mOverlay);
        mKeys = new KeyInput(*mHost, *mDocument, *mOverlay, *mInput);
        mHostUndone = 0;
        auto* undo = new QAction(&mHost->mWindow);
        undo->setShortcut(QKeySequence::Undo);
        connect(undo, &QAction::triggered, this, [this] { ++mHostUndone; });
        mHost->mWindow.addAction(undo);
        mHost->open();
        mOverlay->show();
        mOverlay->updateHandles();
        mInput->setListening(true);
        mKeys->setListening(true);
        mHost->mCanvas->setFocus();
        QTRY_VERIFY(mHost->mCanvas->hasFocus());
    }

    void cleanup()
    {
        mHost.reset();
        mDocument.reset();
    }

    void undoIsOursWhileThereIsSomething()
    {
        dragMouse(mHost->mCanvas, {{200, 150}, {230, 150}});
        key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(light().x, 200.0);
        QCOMPARE(mHostUndone, 0);
        key(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
        QCOMPARE(light().x, 230.0);
        key(Qt::Key_Z, Qt::ControlModifier);
        key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(mHostUndone, 1);
    }

    void undoDuringADragTakesTheDragBack()
    {
        dragMouse(mHost->mCanvas, {{200, 150}, {230, 150}});
        dragMouse(mHost->mCanvas, {{230, 150}, {260, 150}}, Qt::NoModifier, false);
        key(Qt::Key_Escape);
        QCOMPARE(light().x, 230.0);
        QVERIFY(!mInput->isDragging());
    }

    void undoIsTheProgramsOnceTheLampIsPutAway()
    {
        dragMouse(mHost->mCanvas, {{200, 150}, {230, 150}});
        mKeys->setListening(false);
        key(Qt::Key_Z, Qt::ControlModifier);
        QCOMPARE(light().x, 230.0);
        QCOMPARE(mHostUndone, 1);
    }

    void arrowsNudgeOnTheScreenInOneStep()
    {
        mHost->setView(QTransform().translate(300, 0).rotate(90));
        for (int press = 0; press < 3; ++press)
            key(Qt::Key_Right);
        key(Qt::Key_Down, Qt::ShiftModifier);
        QCOMPARE(light().x, 210.0); // down on the screen is right on a canvas turned by a quarter
        QCOMPARE(light().y, 147.0);
        QCOMPARE(mDocument->undoStack()->count(), 1);
    }

    void deleteRemovesTheSelectedLightOnly()
    {
        mDocument->selectLight(-1);
        key(Qt::Key_Delete);
        QCOMPARE(mDocument->scene().lights.size(), 1);
        mDocument->selectLight(0);
        key(Qt::Key_Delete);
        QCOMPARE(mDocument->scene().lights.size(), 0);
        mDocument->undoStack()->undo();
        QCOMPARE(mDocument->scene().lights.size(), 1);
    }

    void holdingDShowsTheDrawing()
    {
        PreviewImage image;
        image.picture = QImage(4, 4, QImage::Format_RGBA8888_Premultiplied);
        image.picture.fill(Qt::red);
        image.crop = QRectF(0, 0, 400, 300);
        mOverlay->setPicture(image, QTransform());
        QVERIFY(mOverlay->showsPicture());
        QTest::keyPress(mHost->mCanvas, Qt::Key_D);
        QVERIFY(!mOverlay->showsPicture());
        QTest::keyRelease(mHost->mCanvas, Qt::Key_D);
        QVERIFY(mOverlay->showsPicture());
        QTest::keyPress(mHost->mCanvas, Qt::Key_D);
        mKeys->setListening(false);
        QVERIFY(mOverlay->showsPicture());
    }

    void holdingDWorksAfterAWidgetOfThePanelWasUsed()
    {
        PreviewImage image;
        image.picture = QImage(4, 4, QImage::Format_RGBA8888_Premultiplied);
        image.picture.fill(Qt::red);
        image.crop = QRectF(0, 0, 400, 300);
        mOverlay->setPicture(image, QTransform());
        const QVector<QWidget*> controls{new QPushButton(mHost->mCanvas), new QSlider(mHost->mCanvas),
                                         new QComboBox(mHost->mCanvas), new QDoubleSpinBox(mHost->mCanvas)};
        for (QWidget* control : controls)
        {
            control->show();
            control->setFocus();
            QTRY_VERIFY(control->hasFocus());
            QTest::keyPress(control, Qt::Key_D);
            QVERIFY2(!mOverlay->showsPicture(), control->metaObject()->className());
            QTest::keyRelease(control, Qt::Key_D);
            QVERIFY(mOverlay->showsPicture());
        }
    }

    void textThatIsTypedElsewhereKeepsItsUndo()
    {
        dragMouse(mHost->mCanvas, {{200, 150}, {230, 150}});
        auto* name = new QLineEdit(mHost->mCanvas);
        name->show();
        name->setFocus();
        QTRY_VERIFY(name->hasFocus());
        QTest::keyClicks(name, QStringLiteral("abd"));
        QCOMPARE(name->text(), QStringLiteral("abd"));
        QTest::keyClick(name, Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(name->text() != QStringLiteral("abd"));
        QCOMPARE(light().x, 230.0);
    }
};

QTEST_MAIN(KeysTest)
#include "test_keys.moc"
