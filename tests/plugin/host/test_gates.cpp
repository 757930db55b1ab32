// Other versions of Pencil2D: each ability can be missing alone, and nothing crashes.
#include "host/export_dialog.h"
#include "host/pencil2d_host.h"
#include "imitation.h"

#include <QDialog>
#include <QGridLayout>
#include <QLabel>
#include <QMenuBar>
#include <QSignalSpy>
#include <QSpinBox>
#include <QStatusBar>
#include <QTest>

using namespace lampblack;
using Ability = Host::Ability;

namespace
{

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

    void theProgramsColoursAreHeard()
    {
        const auto window = bareWindow();
        auto* colours = new ColorManager;
        colours->setParent(window.get());
        const std::unique_ptr<Host> host(createHost(nullptr));
        QSignalSpy chosen(host.get(), &Host::colourChosen);
        Q_EMIT colours->colorChanged(Qt::red, 3);
        QCOMPARE(chosen.size(), 1);
        QCOMPARE(chosen[0][0].value<QColor>(), QColor(Qt::red));
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
