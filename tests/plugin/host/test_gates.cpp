// Other versions of Pencil2D: each ability can be missing alone, and nothing crashes.
#include "host/export_dialog.h"
#include "host/pencil2d_host.h"

#include <QButtonGroup>
#include <QDialog>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMenuBar>
#include <QPainter>
#include <QShortcutEvent>
#include <QSignalSpy>
#include <QSpinBox>
#include <QStatusBar>
#include <QTest>
#include <QToolButton>

#include <memory>

/// Paints a red drawing, a tool's handle, and over them a guide, as Pencil2D 0.7 does.
class ScribbleArea : public QWidget
{
    Q_OBJECT
protected:
    void paintEvent(QPaintEvent*) override
    {
        QPixmap drawing(size());
        drawing.fill(Qt::red);
        QPainter painter(this);
        painter.drawPixmap(0, 0, drawing);
        painter.drawRect(2, 2, 6, 6);
        painter.setWorldTransform(QTransform::fromTranslate(10, 0));
        painter.setCompositionMode(QPainter::RasterOp_NotSourceAndNotDestination);
        painter.setPen(Qt::black);
        painter.drawLine(0, 20, 10, 20);
    }
};

class Editor : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void scrubbed(int);
    void objectLoaded();
};

class PlaybackManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void playStateChanged(bool);
};

class LayerManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void currentLayerChanged(int);
};

class ViewManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void viewChanged();
};

class ToolOptionWidget : public QDockWidget
{
    Q_OBJECT
};

class TimeLineCells : public QWidget
{
    Q_OBJECT
public Q_SLOTS:
    void vScrollChange(int) {}
};

class TimeControls : public QWidget
{
    Q_OBJECT
};

class ColorPaletteWidget : public QDockWidget
{
    Q_OBJECT
};

enum ToolType : int
{
};

class ToolManager : public QObject
{
    Q_OBJECT
Q_SIGNALS:
    void toolChanged(ToolType);
};

/// As in Pencil2D 0.7.2: what the dock of the tools holds, with the buttons in a group.
class ToolBoxWidget : public QWidget
{
    Q_OBJECT
public:
    ToolBoxWidget()
    {
        auto* layout = new QHBoxLayout(this);
        auto* group = new QButtonGroup(this);
        for (QToolButton* button : {&pencil, &brush})
        {
            button->setCheckable(true);
            layout->addWidget(button);
            group->addButton(button);
        }
        pencil.setChecked(true);
    }
    QToolButton pencil{this};
    QToolButton brush{this};
};

class RecentFileMenu : public QMenu
{
    Q_OBJECT
};

class MainWindow2 : public QMainWindow
{
    Q_OBJECT
};

using namespace lampblack;
using Ability = Host::Ability;

namespace
{

/// A window with nothing in it but what every Pencil2D has.
std::unique_ptr<MainWindow2> bareWindow()
{
    auto window = std::make_unique<MainWindow2>();
    window->setCentralWidget(new ScribbleArea);
    (new Editor)->setParent(window.get());
    window->show();
    return window;
}

QVector<Ability> abilities(const MainWindow2& window)
{
    QVector<Ability> can;
    const Parts parts = findParts(const_cast<MainWindow2*>(&window));
    for (const Ability ability : {Ability::Palette, Ability::Panel, Ability::Frames, Ability::Layers,
                                  Ability::View, Ability::Undo, Ability::Project})
    {
        if (whyNot(parts, ability).isEmpty())
            can.append(ability);
    }
    return can;
}

} // namespace

class Gates : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void otherProgramsAreLeftAlone()
    {
        QMainWindow other;
        other.show();
        QVERIFY(createHost(nullptr) == nullptr);
        MainWindow2 hidden;
        QVERIFY(createHost(nullptr) == nullptr);
        MainWindow2 empty;
        empty.show();
        QTest::ignoreMessage(QtInfoMsg, "Lampblack: this is not a Pencil2D that it knows.");
        QVERIFY(createHost(nullptr) == nullptr);
    }

    void eachAbilityStandsAlone()
    {
        const auto window = bareWindow();
        QCOMPARE(abilities(*window), QVector<Ability>({Ability::Project}));

        auto* undo = new QAction(window.get());
        undo->setObjectName(QStringLiteral("actionUndo"));
        QCOMPARE(abilities(*window), QVector<Ability>({Ability::Undo, Ability::Project}));

        auto* options = new ToolOptionWidget;
        auto* page = new QWidget;
        page->setLayout(new QGridLayout);
        options->setWidget(page);
        window->addDockWidget(Qt::LeftDockWidgetArea, options);
        QVERIFY(abilities(*window).contains(Ability::Panel));

        auto* sequence = new QAction(window.get());
        sequence->setObjectName(QStringLiteral("actionExport_ImageSeq"));
        QVERIFY(!abilities(*window).contains(Ability::Frames));
        (new PlaybackManager)->setParent(window.get());
        QVERIFY(abilities(*window).contains(Ability::Frames));

        (new ViewManager)->setParent(window.get());
        QVERIFY(abilities(*window).contains(Ability::View));
        QVERIFY(!abilities(*window).contains(Ability::Palette));
    }

    void theToolIsExclusiveInAGroupOfButtons()
    {
        const auto window = bareWindow();
        auto* tools = new ToolManager;
        tools->setParent(window.get());
        auto* box = new ToolBoxWidget;
        auto* dock = new QDockWidget;
        dock->setWidget(box);
        window->addDockWidget(Qt::LeftDockWidgetArea, dock);
        const std::unique_ptr<Host> host(createHost(nullptr));
        QVERIFY(host->can(Ability::Palette));
        QAction tool(QStringLiteral("Lamp"));
        tool.setCheckable(true);
        host->addTool(&tool);
        QSignalSpy active(host.get(), &Host::toolActivated);
        tool.trigger();
        QVERIFY(!box->pencil.isChecked() && !box->brush.isChecked());

        // A key was released, or the space bar is held: the program announces a tool, and checks its button.
        for (QToolButton* announced : {&box->pencil, &box->brush, &box->pencil})
        {
            announced->setChecked(true);
            Q_EMIT tools->toolChanged({});
            QVERIFY(tool.isChecked());
            QVERIFY(!box->pencil.isChecked() && !box->brush.isChecked());
        }
        QCOMPARE(active.size(), 1);
        QTest::mouseClick(&box->brush, Qt::LeftButton);
        QVERIFY(!tool.isChecked() && box->brush.isChecked() && !box->pencil.isChecked());
        tool.trigger();
        tool.setChecked(false);
        QVERIFY2(box->brush.isChecked(), "the tool before is in use again");
        QCOMPARE(active.size(), 4);
    }

    void withoutAPaletteTheToolIsInTheMenuAndThePanelIsShown()
    {
        const auto window = bareWindow();
        QMenu* menu = window->menuBar()->addMenu(QStringLiteral("Tools"));
        menu->setObjectName(QStringLiteral("menuTools"));
        QAction* pencil = menu->addAction(QStringLiteral("Pencil"));
        auto* options = new ToolOptionWidget;
        auto* page = new QWidget;
        page->setLayout(new QGridLayout);
        options->setWidget(page);
        window->addDockWidget(Qt::LeftDockWidgetArea, options);
        options->show();
        const std::unique_ptr<Host> host(createHost(nullptr));
        QVERIFY(!host->can(Ability::Palette));
        QAction tool(QStringLiteral("Lamp"));
        tool.setCheckable(true);
        host->addTool(&tool);
        auto* panel = new QLabel(QStringLiteral("panel"));
        host->setToolPanel(panel);
        QSignalSpy active(host.get(), &Host::toolActivated);
        QVERIFY(menu->actions().contains(&tool));
        tool.trigger();
        QVERIFY(panel->isVisible());
        pencil->trigger();
        QVERIFY(!tool.isChecked() && !panel->isVisible());
        QCOMPARE(active.size(), 2);
    }

    void theHintComesBackAfterOtherMessages()
    {
        const auto window = bareWindow();
        const std::unique_ptr<Host> host(createHost(nullptr));
        host->showStatus(QStringLiteral("Drag a light"));
        host->showStatus(QStringLiteral("Frame 3 of 9"), 20);
        QCOMPARE(window->statusBar()->currentMessage(), QStringLiteral("Frame 3 of 9"));
        QTRY_COMPARE(window->statusBar()->currentMessage(), QStringLiteral("Drag a light"));
        window->statusBar()->clearMessage(); // as when the pointer leaves an entry of a menu
        QTRY_COMPARE(window->statusBar()->currentMessage(), QStringLiteral("Drag a light"));
        host->showStatus({});
        QTest::qWait(50);
        QCOMPARE(window->statusBar()->currentMessage(), QString());
    }

    void guidesArePaintedWithoutTheDrawing()
    {
        const auto window = bareWindow();
        QAction thirds;
        thirds.setObjectName(QStringLiteral("actionThirds"));
        thirds.setCheckable(true);
        thirds.setParent(window.get());
        const std::unique_ptr<Host> host(createHost(nullptr));
        host->canvas()->resize(60, 40);
        const auto shown = [&host]
        {
            QImage picture(60, 40, QImage::Format_RGB32);
            picture.fill(Qt::yellow);
            QPainter painter(&picture);
            painter.setClipRect(0, 0, 15, 40);
            host->paintGuides(&painter);
            return picture;
        };
        QImage plain(60, 40, QImage::Format_RGB32);
        plain.fill(Qt::yellow);
        QCOMPARE(shown(), plain);
        thirds.setChecked(true);
        for (int x = 10; x < 15; ++x)
            plain.setPixelColor(x, 20, Qt::blue);
        QCOMPARE(shown(), plain);
        thirds.setParent(nullptr);
    }

    void bareHostSaysWhyNot()
    {
        const auto window = bareWindow();
        const std::unique_ptr<Host> host(createHost(nullptr));
        QVERIFY(host != nullptr);
        QVERIFY(!host->can(Ability::Frames));
        QVERIFY(host->whyNot(Ability::Frames).endsWith(QLatin1Char('.')));
        QVERIFY(!host->canvasToWidget().has_value());
        QSignalSpy failed(host.get(), &Host::exportFailed);
        host->requestFrames(1, 2);
        QCOMPARE(failed.size(), 2);
        QAction tool;
        tool.setCheckable(true);
        host->addTool(&tool);
        QLabel panel;
        host->setToolPanel(&panel);
        tool.setChecked(true);
        QTest::qWait(100);
        QVERIFY(host->layers().isEmpty());
        QVERIFY(!host->openProject(QStringLiteral("/nowhere.pclx")));
    }

    void viewThatDoesNotAnswerIsNotKnown()
    {
        const auto window = bareWindow();
        (new ViewManager)->setParent(window.get());
        const std::unique_ptr<Host> host(createHost(nullptr));
        QVERIFY(!host->can(Ability::View));
        QVERIFY(!host->canvasToWidget().has_value());
    }

    void strangeExportDialogFails()
    {
        const auto window = bareWindow();
        auto* sequence = new QAction(window.get());
        sequence->setObjectName(QStringLiteral("actionExport_ImageSeq"));
        connect(sequence, &QAction::triggered, window.get(), [] { QDialog().exec(); });
        ExportDialog dialog(findParts(window.get()));
        const ExportResult exported = dialog.exportFrames(1, 3, {}, QStringLiteral("/nowhere"));
        QVERIFY(exported.files.isEmpty());
        QVERIFY(!exported.error.isEmpty());
    }

    void anotherProjectAsksFirst()
    {
        const auto window = bareWindow();
        QMenu* file = window->menuBar()->addMenu(QStringLiteral("&File"));
        file->setObjectName(QStringLiteral("menuFile"));
        int left = 0;
        const auto add = [&](QMenu* menu, const char* name)
        {
            QAction* action = menu->addAction(QLatin1String(name));
            action->setObjectName(QLatin1String(name));
            connect(action, &QAction::triggered, window.get(), [&left] { ++left; });
            return action;
        };
        QAction* open = add(file, "actionOpen");
        open->setShortcut(QKeySequence::Open);
        auto* recent = new RecentFileMenu;
        file->addMenu(recent);
        add(recent, "walk.pclx");
        recent->addSeparator();
        add(recent, "clear");
        const std::unique_ptr<Host> host(createHost(nullptr));
        QVERIFY(host != nullptr);
        int asked = 0;
        bool may = false;
        host->guardLeaving(
            [&]
            {
                ++asked;
                return may;
            });
        const auto choose = [&](QMenu* menu, int entry)
        {
            menu->popup({});
            for (int down = 0; down <= entry; ++down)
                QTest::keyClick(menu, Qt::Key_Down);
            QTest::keyClick(menu, Qt::Key_Return);
            QCoreApplication::processEvents();
        };
        for (const bool agreed : {false, true})
        {
            may = agreed;
            const int before = left;
            choose(file, 0);
            QShortcutEvent shortcut(open->shortcut(), 0);
            QCoreApplication::sendEvent(open, &shortcut);
            choose(recent, 0);
            QCOMPARE(left, before + (agreed ? 3 : 0));
        }
        QCOMPARE(asked, 6);
        choose(recent, 1);
        QCOMPARE(left, 4);
        QCOMPARE(asked, 6);
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QVERIFY(open->isVisible());
        QCOMPARE(file->actions().size(), 2);
    }

    void theTitleMarksALightThatIsNotSaved()
    {
        const auto window = bareWindow();
        window->setWindowTitle(QStringLiteral("[*]/home/ann/walk.pclx"));
        const std::unique_ptr<Host> host(createHost(nullptr));
        host->markModified(true);
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]*/home/ann/walk.pclx"));
        QVERIFY2(!host->isModified(), "the drawings are saved");
        QCOMPARE(host->projectPath(), QStringLiteral("/home/ann/walk.pclx"));
        window->setWindowModified(true);
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]/home/ann/walk.pclx"));
        window->setWindowModified(false);
        window->setWindowTitle(QStringLiteral("[*]/home/ann/run.pclx"));
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]*/home/ann/run.pclx"));
        QTest::qWait(300);
        QCOMPARE(host->projectPath(), QStringLiteral("/home/ann/run.pclx"));
        host->markModified(false);
        QCOMPARE(window->windowTitle(), QStringLiteral("[*]/home/ann/run.pclx"));
    }

    void theMenuSaysLight()
    {
        const auto window = bareWindow();
        QMenu* animation = window->menuBar()->addMenu(QStringLiteral("Animation"));
        animation->setObjectName(QStringLiteral("menuAnimation"));
        animation->addAction(QStringLiteral("Flip Rolling"));
        QAction render(QStringLiteral("Render All Frames"));
        {
            const std::unique_ptr<Host> host(createHost(nullptr));
            host->addLightAction(&render);
            const QList<QAction*> entries = animation->actions();
            QCOMPARE(entries.size(), 3);
            QVERIFY(entries[1]->isSeparator());
            QCOMPARE(entries[2]->text(), QStringLiteral("Light"));
            QCOMPARE(entries[2]->menu()->actions(), QList<QAction*>{&render});
        }
        QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
        QCOMPARE(animation->actions().size(), 1);
    }

    void aLoopBeyondTheLastDrawingEndsWithIt()
    {
        const auto window = bareWindow();
        auto* controls = new TimeControls;
        controls->setParent(window.get());
        QVector<QSpinBox*> boxes;
        for (int place = 0; place < 3; ++place)
        {
            boxes << new QSpinBox(controls);
            boxes.last()->setMaximum(100);
        }
        boxes[1]->setValue(1);
        boxes[2]->setValue(16);
        const std::unique_ptr<Host> host(createHost(nullptr));
        QCOMPARE(host->loopRange().last, host->frameCount());
    }

    void aDockOfOursFitsAndComesBackAsItWasLeft()
    {
        const auto window = bareWindow();
        auto* palette = new ColorPaletteWidget;
        palette->setObjectName(QStringLiteral("palette"));
        palette->setWidget(new QWidget);
        window->addDockWidget(Qt::RightDockWidgetArea, palette);
        palette->show();
        const auto ours = []
        {
            auto* dock = new QDockWidget(QStringLiteral("Materials"));
            dock->setObjectName(QStringLiteral("lampblack.materials"));
            dock->setWidget(new QWidget);
            dock->widget()->setMinimumHeight(200);
            return dock;
        };
        QByteArray left;
        {
            const int before = window->minimumSizeHint().height();
            const std::unique_ptr<Host> host(createHost(nullptr));
            const std::unique_ptr<QDockWidget> dock(ours());
            host->addDock(dock.get());
            QCoreApplication::processEvents();
            QVERIFY(window->tabifiedDockWidgets(palette).contains(dock.get()));
            QVERIFY(window->minimumSizeHint().height() < before + 300);
            dock->close();
            left = window->saveState();
        }
        window->restoreState(left); // before the plugin is there
        const std::unique_ptr<Host> host(createHost(nullptr));
        const std::unique_ptr<QDockWidget> dock(ours());
        host->addDock(dock.get());
        QVERIFY2(dock->isHidden(), "it was closed");
    }

    void windowMayGoFirst()
    {
        auto window = bareWindow();
        const std::unique_ptr<Host> host(createHost(nullptr));
        window.reset();
        QVERIFY(host->window() == nullptr && host->canvas() == nullptr);
        QVERIFY(!host->can(Ability::View) && !host->canvasToWidget().has_value());
        host->requestFrames(1, 1);
        host->showStatus(QStringLiteral("late"));
        QTest::qWait(100);
    }
};

QTEST_MAIN(Gates)
#include "test_gates.moc"
