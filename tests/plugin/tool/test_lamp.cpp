// The lamp tool as a whole.
#include "support/fake_host.h"
#include "support/fake_worker.h"
#include "support/mouse.h"
#include "support/scenes.h"
#include "tool/canvas/canvas_overlay.h"
#include "tool/lamp_tool.h"
#include "tool/panel/problem_card.h"

#include <QComboBox>
#include <QDialog>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QToolButton>

using namespace lampblack;

namespace
{

const QColor Green(0, 160, 0);

PreviewImage image(Show show)
{
    PreviewImage picture;
    picture.frame = 1;
    picture.show = show;
    picture.crop = QRectF(0, 0, 400, 300);
    picture.picture = QImage(400, 300, QImage::Format_RGBA8888_Premultiplied);
    picture.picture.fill(Green);
    return picture;
}

} // namespace

class LampTest : public QObject
{
    Q_OBJECT

private:
    static bool isGreen(const FakeHost& host)
    {
        return QColor(host.mCanvas->grab().toImage().pixel(20, 290)) == Green;
    }

private Q_SLOTS:
    void takesItsPlaces()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        QCOMPARE(host.mTool, lamp.toolAction());
        QVERIFY(!host.mTool->icon().pixmap(24).isNull());
        QCOMPARE(host.mTool->shortcut(), QKeySequence(Qt::Key_L));
        QVERIFY(host.mPanel != nullptr);
        QVERIFY(host.mLightMenu.contains(lamp.renderAction()));
        QVERIFY(host.mLightMenu.contains(lamp.keepAction()));
    }

    void aCardCanBeTurnedAway()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        const auto choiceOf = [](const FakeHost& shown)
        {
            return shown.mPanel->findChild<QComboBox*>(QStringLiteral("lampblack.panel.device"));
        };
        {
            LampTool lamp(host, worker, document);
            host.open();
            QVERIFY2(choiceOf(host)->findText(QStringLiteral("Processor")) < 0, "there is no card");
            Q_EMIT worker.cardFound(QStringLiteral("Paper Card"));
            QCOMPARE(choiceOf(host)->itemData(0, Qt::ToolTipRole).toString(), QStringLiteral("Paper Card"));
            QTest::keyClick(choiceOf(host), Qt::Key_Down);
            QCOMPARE(worker.mDevice, Worker::Device::Processor);
        }
        FakeHost another;
        another.mRemembered = host.mRemembered;
        FakeWorker later;
        LampTool lamp(another, later, document);
        QCOMPARE(later.mDevice, Worker::Device::Processor);
        another.open();
        QCOMPARE(choiceOf(another)->currentText(), QStringLiteral("Processor"));
        QVERIFY2(choiceOf(another)->findText(QStringLiteral("Card")) >= 0, "it can be taken again");
    }

    void anotherComputerCanWork()
    {
        const Computer studio{QStringLiteral("10.0.0.5:7100"), QStringLiteral("/keys/studio.key"),
                              QStringLiteral("/keys/ana.key_secret")};
        FakeHost host;
        SceneDocument document;
        {
            FakeWorker worker;
            LampTool lamp(host, worker, document);
            host.open();
            auto* choice = host.mPanel->findChild<QComboBox*>(QStringLiteral("lampblack.panel.device"));
            const auto dialog = [&host]
            {
                return host.mPanel->findChild<QDialog*>(QStringLiteral("lampblack.computer"));
            };
            QTest::keyClick(choice, Qt::Key_Down);
            QVERIFY(dialog() != nullptr);
            auto* buttons = dialog()->findChild<QDialogButtonBox*>();
            QVERIFY2(!buttons->button(QDialogButtonBox::Ok)->isEnabled(), "nothing is said yet");
            dialog()->reject();
            QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
            QCOMPARE(choice->currentIndex(), 0);
            QVERIFY(!worker.mComputer);
            QTest::keyClick(choice, Qt::Key_Down);
            const auto say = [&dialog](const char* name, const QString& text)
            {
                dialog()
                    ->findChild<QLineEdit*>(QStringLiteral("lampblack.computer.") + QLatin1String(name))
                    ->setText(text);
            };
            say("address", studio.address);
            say("key", studio.key);
            say("own_key", studio.ownKey);
            dialog()->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Ok)->click();
            QVERIFY(worker.mComputer == studio);
        }
        FakeHost another;
        another.mRemembered = host.mRemembered;
        FakeWorker later;
        LampTool lamp(another, later, document);
        QVERIFY2(later.mComputer == studio, "it is remembered");
        another.open();
        auto* choice = another.mPanel->findChild<QComboBox*>(QStringLiteral("lampblack.panel.device"));
        QTest::keyClick(choice, Qt::Key_Up);
        QVERIFY(!later.mComputer);
    }

    void materialsSayWhatIsMissing()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        auto* hint = host.mWindow.findChild<QLabel*>(QStringLiteral("lampblack.materials.empty"));
        const QString invitation = hint->text();
        host.open();
        QVERIFY2(hint->text() != invitation, "the lamp has been chosen");
        Q_EMIT worker.problem({QStringLiteral("It is not installed."), QStringLiteral("Press Install."),
                               QString(), UserError::Kind::NoWorker});
        QCOMPARE(hint->text(), QStringLiteral("It is not installed. Press Install."));
        Q_EMIT worker.stateChanged(Worker::State::Ready);
        QVERIFY(!hint->text().contains(QStringLiteral("installed")));
    }

    void showsThePictureItIsGivenWhileInUse()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        document.reset(sceneWithLight(200, 150, 200));
        LampTool lamp(host, worker, document);
        QSignalSpy active(&lamp, &LampTool::activeChanged);
        host.open();
        QVERIFY(lamp.isActive());
        QCOMPARE(active.count(), 1);
        lamp.setPicture(image(Show::Lit));
        QVERIFY(isGreen(host));
        lamp.setViewMode(Show::Normals);
        QVERIFY2(!isGreen(host), "another view drops the picture of the last");
        lamp.setPicture(image(Show::Lit));
        QVERIFY2(!isGreen(host), "a late picture of another view is passed over");
        lamp.setPicture(image(Show::Normals));
        QVERIFY(isGreen(host));
        host.mTool->setChecked(false);
        QVERIFY(!lamp.isActive());
        QVERIFY2(!isGreen(host), "another tool sees the drawing");
    }

    void aMovingCameraRegistersEachFrame()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        host.open();
        FrameExport panned;
        panned.frame = 1;
        panned.canvasToImage = QTransform::fromTranslate(-100, 0);
        lamp.setFrame(panned);
        FrameExport still;
        still.frame = 2;
        lamp.setFrame(still);
        lamp.setPicture(image(Show::Lit));
        QVERIFY2(!isGreen(host), "frame 1 starts 100 pixels to the right");
        QCOMPARE(QColor(host.mCanvas->grab().toImage().pixel(120, 290)), Green);
    }

    void aRightClickOpensTheMenu()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        document.reset(sceneWithLight(200, 150, 200));
        LampTool lamp(host, worker, document);
        host.open();
        QTest::mouseClick(host.mCanvas, Qt::RightButton, Qt::NoModifier, QPoint(60, 70));
        auto* menu = host.mCanvas->findChild<QMenu*>(QStringLiteral("lampblack.menu"));
        QVERIFY(menu->isVisible());
        menu->findChild<QAction*>(QStringLiteral("lampblack.menu.floor"))->trigger();
        menu->close();
        QCOMPARE(document.scene().floor->y, 70.0);
    }

    void picksAColourOnTheCanvas()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        document.reset(sceneWithLight(200, 150, 200));
        LampTool lamp(host, worker, document);
        host.open();
        FrameExport frame;
        frame.frame = 1;
        frame.image = QImage(400, 300, QImage::Format_RGBA8888);
        frame.image.fill(QColor(0xdd, 0x3f, 0x2e));
        lamp.setFrame(frame);
        lamp.setPalette({{QStringLiteral("#dd3f2e"), 1000}});
        auto* pick = host.mWindow.findChild<QToolButton*>(QStringLiteral("lampblack.materials.pick"));
        pick->click();
        QVERIFY(pick->isChecked());
        // Over the light, too: while picking there are only colours.
        QTest::mouseClick(host.mCanvas, Qt::LeftButton, Qt::NoModifier, QPoint(200, 150));
        QVERIFY(!pick->isChecked());
        QCOMPARE(document.undoStack()->count(), 0);
    }

    void tellsWhatTheWorkerDoesAndWhatWentWrong()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        auto* line = host.mPanel->findChild<QLabel*>(QStringLiteral("lampblack.panel.worker"));
        QCOMPARE(line->text(), QStringLiteral("Ready"));
        Q_EMIT worker.stateChanged(Worker::State::Restarting);
        QVERIFY(line->text() != QStringLiteral("Ready"));
        Q_EMIT worker.problem({QStringLiteral("It broke."), QString(), QString()});
        auto* card = host.mPanel->findChild<ProblemCard*>();
        QCOMPARE(card->error().what, QStringLiteral("It broke."));
        QCOMPARE(host.mStatus, QStringLiteral("It broke."));
    }

    void anEmptyDrawingIsAnInvitationThatGoesByItself()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        host.open();
        auto* card = host.mPanel->findChild<ProblemCard*>();
        const auto tellBlank = [&worker](int frame)
        {
            Q_EMIT worker.problem({QStringLiteral("Nothing is drawn here yet."), QStringLiteral("Draw."),
                                   QString(), UserError::Kind::NothingDrawn, frame});
        };
        tellBlank(5);
        QVERIFY2(!card->isVisibleTo(host.mPanel), "another frame is shown");
        tellBlank(1);
        QVERIFY(card->isVisibleTo(host.mPanel));
        Q_EMIT host.drawingChanged(1);
        QVERIFY(!card->isVisibleTo(host.mPanel));
        tellBlank(1);
        Q_EMIT worker.imageArrived(worker.pictureOf(1));
        QVERIFY(!card->isVisibleTo(host.mPanel));
        tellBlank(1);
        host.goToFrame(2);
        QVERIFY(!card->isVisibleTo(host.mPanel));
        Q_EMIT worker.problem({QStringLiteral("It broke."), QString(), QString()});
        Q_EMIT worker.imageArrived(worker.pictureOf(2));
        QVERIFY2(card->isVisibleTo(host.mPanel), "other problems stay until they are read");
    }

    void aWorkerThatIsNotThereCanBeTriedAgain()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        host.open();
        auto* card = host.mPanel->findChild<ProblemCard*>();
        auto* retry = card->findChild<QToolButton*>(QStringLiteral("lampblack.panel.problem.retry"));
        Q_EMIT worker.problem({QStringLiteral("It broke."), QString(), QString()});
        QVERIFY(!retry->isVisibleTo(card));
        Q_EMIT worker.problem({QStringLiteral("Lampblack's worker is not installed."), QString(), QString(),
                               UserError::Kind::NoWorker});
        const int started = worker.mStarted;
        QVERIFY(retry->isVisibleTo(card));
        retry->click();
        QCOMPARE(worker.mStarted, started + 1);
        QVERIFY(!card->isVisibleTo(host.mPanel));
    }

    void anotherProjectHasOtherColours()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        const QString row = QStringLiteral("lampblack.materials.row.#dd3f2e");
        lamp.setPalette({{QStringLiteral("#dd3f2e"), 100}});
        QVERIFY(host.mWindow.findChild<QWidget*>(row) != nullptr);
        Q_EMIT host.projectOpened(QString());
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QVERIFY(host.mWindow.findChild<QWidget*>(row) == nullptr);
    }

    void asksForWorkByButtonAndMenu()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        LampTool lamp(host, worker, document);
        QSignalSpy render(&lamp, &LampTool::renderAllRequested);
        QSignalSpy surfaces(&lamp, &LampTool::generateSurfacesRequested);
        host.mPanel->findChild<QPushButton*>(QStringLiteral("lampblack.panel.render"))->click();
        lamp.renderAction()->trigger();
        host.mPanel->findChild<QPushButton*>(QStringLiteral("lampblack.panel.generate"))->click();
        QCOMPARE(render.count(), 2);
        QCOMPARE(surfaces.count(), 1);
    }

    void aHostThatOffersNothingIsSurvived()
    {
        FakeHost host;
        host.mCannot = {Host::Ability::Palette, Host::Ability::Panel,  Host::Ability::View,
                        Host::Ability::Layers,  Host::Ability::Frames, Host::Ability::Undo};
        host.mView.reset();
        FakeWorker worker;
        SceneDocument document;
        document.reset(sceneWithLight(200, 150, 200));
        LampTool lamp(host, worker, document);
        host.open();
        QVERIFY(host.mWindow.findChild<QLabel*>(QStringLiteral("lampblack.panel.blind")) != nullptr);
        QVERIFY(host.mLightMenu.contains(lamp.toolAction()));
        QVERIFY(lamp.isActive());
        lamp.toolAction()->trigger(); // the menu is the only way to it
        QVERIFY(!lamp.isActive());
        lamp.toolAction()->trigger();
        QVERIFY(lamp.isActive());
        lamp.setPicture(image(Show::Lit));
        dragMouse(host.mCanvas, {{200, 150}, {250, 180}});
        QTest::mouseClick(host.mCanvas, Qt::RightButton, Qt::NoModifier, QPoint(60, 70));
        QCOMPARE(document.undoStack()->count(), 0);
    }

    void leavesNothingBehind()
    {
        FakeHost host;
        FakeWorker worker;
        SceneDocument document;
        {
            LampTool lamp(host, worker, document);
            host.open();
        }
        QVERIFY(host.mCanvas->findChildren<QWidget*>().isEmpty());
        QVERIFY(host.mWindow.findChild<QWidget*>(QStringLiteral("lampblack.materials")) == nullptr);
        QTest::mouseClick(host.mCanvas, Qt::LeftButton, Qt::NoModifier, QPoint(60, 70));
    }

    void aWindowThatGoesFirstIsSurvived()
    {
        FakeWorker worker;
        SceneDocument document;
        auto host = std::make_unique<FakeHost>();
        LampTool* lamp = new LampTool(*host, worker, document);
        host->open();
        lamp->setParent(&document);
        document.reset(sceneWithLight(10, 10, 200));
        delete host->mWindow.takeCentralWidget();
        lamp->setPicture(image(Show::Lit));
        lamp->clearPicture();
        delete lamp;
    }
};

QTEST_MAIN(LampTest)
#include "test_lamp.moc"
